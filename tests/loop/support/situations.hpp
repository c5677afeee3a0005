// Everything that a channel can be doing when something breaks.
#pragma once

#include <array>
#include <string_view>

#include "loop/support/rig.hpp"

namespace supercoil::test {

enum class Situation {
  disarmed,
  arming,
  armed,
  pi,
  pd_ff,
  mrac,
  power,
  identify,
  calibrate,
  fault
};

struct SituationName {
  Situation situation;
  std::string_view name;
};
inline constexpr std::array<SituationName, 10> situations{{
    {Situation::disarmed, "disarmed"},
    {Situation::arming, "arming"},
    {Situation::armed, "armed"},
    {Situation::pi, "active, pi"},
    {Situation::pd_ff, "active, pd_ff"},
    {Situation::mrac, "active, mrac"},
    {Situation::power, "active, power"},
    {Situation::identify, "active, identify"},
    {Situation::calibrate, "active, calibrate"},
    {Situation::fault, "fault"},
}};

/// Boots a rig and brings it into the situation, with its neighbour active; the muscle is warm in
/// the active ones. For `fault` the emergency stop is pressed and released: the neighbour has that
/// fault as well.
inline void bring_to(Situation situation, Rig& rig) {
  rig.boot();
  rig.start_neighbour();
  rig.run(0.3);
  if (situation == Situation::disarmed) return;
  if (situation == Situation::fault) {
    rig.board.stop_circuit.level.high = false;
    rig.run_ticks(3);
    rig.board.stop_circuit.level.high = true;
    rig.run_ticks(3);
    return;
  }
  rig.arm();
  if (situation == Situation::arming) return;
  rig.run(0.2);
  if (situation == Situation::armed) return;
  if (situation == Situation::pd_ff) rig.send(Verb::controller, 1);
  if (situation == Situation::mrac) rig.send(Verb::controller, 2);
  rig.heat(situation == Situation::power       ? Task::power
           : situation == Situation::identify  ? Task::identify
           : situation == Situation::calibrate ? Task::calibrate
                                               : Task::position);
  rig.run(situation == Situation::calibrate ? 0.5 : 3.0);
}

}  // namespace supercoil::test
