// Two muscles of a rough board that turn one joint against each other.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

namespace supercoil::test {

inline constexpr std::uint8_t agonist = Rig::tested;
inline constexpr std::uint8_t antagonist = Rig::neighbour;
inline constexpr double lever_m = 0.015;
inline constexpr double degree_m = lever_m * 3.14159265358979 / 180.0;

/// Both muscles are known exactly, as after identify. Resistance does not tell temperature here: it
/// would reveal sooner what is wrong.
inline RigSettings known_joint(double co_contraction_W) {
  RigSettings settings = joint_board();
  for (std::size_t i = 0; i < settings.firmware.channels.size(); ++i) {
    ChannelSettings& channel = settings.firmware.channels[i];
    host_sim::MuscleChannelSettings& muscle = settings.board.channels[i];
    channel.muscle.heat_transfer_W_per_K = muscle.plant.heat_transfer_W_per_K;
    channel.muscle.force_per_kelvin_N_per_K = muscle.plant.force_per_kelvin_N_per_K;
    channel.muscle_identified = true;
    channel.heater.temperature_coefficient_per_K = 0.0;
    muscle.temperature_coefficient_per_K = 0.0;
  }
  settings.firmware.joints[0].co_contraction_W = co_contraction_W;
  return settings;
}

inline void begin(Rig& rig) {
  rig.boot();
  rig.arm();
  rig.run(0.2);
}

/// Starts the mode at the agonist; whether it ends before max_s, with all that it goes on to.
inline bool completes_mode(Rig& rig, Verb mode, double max_s) {
  CHECK(rig.answer_of(agonist, mode) == Refusal::none);
  return rig.run_until(
      [&] {
        rig.send(Verb::renew);
        return rig.state() != State::active;
      },
      max_s);
}

/// Whether it ends in a fault before max_s.
inline bool faults_while_following(Rig& rig, double max_s,
                                   const std::function<double()>& reference_m) {
  return rig.run_until(
      [&] {
        rig.send(Verb::position, reference_m());
        return rig.state() == State::fault;
      },
      max_s);
}

/// The fixture of a test group.
struct JointCase : Utest {
  Rig rig{joint_board()};

  State state_of(std::uint8_t channel) { return rig.loop.channel(channel).state().state(); }
  Fault fault_of(std::uint8_t channel) { return rig.loop.channel(channel).state().first_cause(); }
  const Snapshot& of(std::uint8_t channel) { return rig.loop.channel(channel).snapshot(); }
  double angle_deg() { return rig.board.joint(0).plant().position_m() / degree_m; }
  bool both(State state) { return state_of(agonist) == state && state_of(antagonist) == state; }
  bool both_off() {
    bool off = true;
    for (const std::uint8_t i : {agonist, antagonist}) {
      host_sim::MuscleChannel& muscle = rig.board.channel(i);
      off = off && !muscle.enable.high() && muscle.pwm.duty(rig.board.true_time()) == 0.0;
    }
    return off;
  }

  void arm() {
    rig.boot();
    rig.arm();
    CHECK(both(State::armed));
    rig.run(0.2);
  }
  void follow(double position_m) { rig.send(Verb::position, position_m); }
  /// Renews the command at each tick; `reference_m` takes the time since now.
  void follow_for(
      double time_s, const std::function<double(double)>& reference_m,
      const std::function<void()>& look = [] {}) {
    const double from_s = rig.time_s();
    while (rig.time_s() - from_s < time_s) {
      follow(reference_m(rig.time_s() - from_s));
      rig.tick();
      look();
    }
  }
  void hold(double position_m, double time_s) {
    follow_for(time_s, [=](double) { return position_m; });
  }
};

}  // namespace supercoil::test
