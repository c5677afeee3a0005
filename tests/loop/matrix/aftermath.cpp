#include "loop/matrix/aftermath.hpp"

#include "loop/matrix/neighbour.hpp"

namespace supercoil::test {

namespace {

/// No detector trips.
bool quiet(const Rig& rig) {
  return rig.loop.channel(Rig::tested).present_fault() == Fault::none &&
         rig.loop.supervisor().verdict().fault() == Fault::none;
}

/// Holds `reset` from before the cause goes until a while after it.
std::string hold_reset(Rig& rig) {
  const Fault board = rig.loop.board_fault();
  const double max_s = rig.time_s() + 3.0;
  double end_s = max_s;
  while (rig.time_s() < end_s) {
    rig.send(Verb::reset);
    rig.tick();
    if (rig.state() != State::fault) return "it was reset by a held command";
    if (rig.loop.board_fault() != board) return "the board was reset by a held command";
    if (end_s == max_s && quiet(rig)) end_s = rig.time_s() + 0.05;
  }
  return "";
}

/// Whatever is commanded, neither channel heats, not even when the supply closes for the self-test.
std::string restarts(Rig& rig, Fault neighbours) {
  const double end_s = rig.time_s() + 0.4;
  for (int i = 0; rig.time_s() < end_s; ++i) {
    // Refused commands in a row would be a fault of their own.
    const Verb verb = i % 2 == 0 ? Verb::position : Verb::disarm;
    rig.send(verb, 0.01);
    rig.loop.send({Rig::neighbour, verb, 0.01});
    rig.tick();
    if (rig.muscle().true_power_W() > 0.0 || rig.state() != State::disarmed) {
      return "it restarted by itself";
    }
    if (rig.board.channel(Rig::neighbour).true_power_W() > 0.0) return "the neighbour restarted";
    if (std::string wrong = neighbour_wrong(rig, neighbours); !wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace

std::string aftermath(const FaultCase& c, Rig& rig, Fault first, Fault neighbours) {
  // A second fault does not replace the first. This one makes the neighbour cold as well.
  rig.board.stop_circuit.level.high = false;
  rig.run_ticks(3);
  if (rig.fault() != first) return "the first cause became " + text(rig.fault());
  if (neighbours == Fault::none) neighbours = Fault::emergency_stop;
  if (std::string wrong = neighbour_wrong(rig, neighbours); !wrong.empty()) return wrong;
  if (c.fault != Fault::emergency_stop) rig.board.stop_circuit.level.high = true;
  rig.run_ticks(3);
  // A reset does nothing while the cause is there. (Some causes do not show once power is off.)
  const bool seen = !quiet(rig);
  rig.send(Verb::reset);
  rig.tick();
  if (seen && (rig.state() != State::fault || rig.answer_to_reset != Refusal::cause_persists)) {
    return "it was reset while its cause was there";
  }
  c.remove(rig);
  rig.commands_flow = true;
  if (rig.state() == State::fault) {
    if (std::string wrong = hold_reset(rig); !wrong.empty()) return wrong;
    rig.run_ticks(2);
    rig.send(Verb::reset);
    rig.tick();
  }
  // One edge resets both the channel and its board.
  if (rig.state() != State::disarmed || rig.loop.board_fault() != Fault::none) {
    return "it cannot be reset: " + text(rig.loop.channel(Rig::tested).present_fault()) +
           ", board " + text(rig.loop.board_fault());
  }
  if (std::string wrong = restarts(rig, neighbours); !wrong.empty()) return wrong;
  // Each channel has its own reset.
  rig.loop.send({Rig::neighbour, Verb::reset, 0.0});
  rig.tick();
  const bool leaves = rig.loop.channel(Rig::neighbour).state().state() == State::disarmed;
  return leaves ? "" : "the neighbour cannot be reset";
}

}  // namespace supercoil::test
