// Three muscles of a rough board that pull one load together.
#pragma once

#include <cstdint>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"

namespace supercoil::test {

inline constexpr std::uint8_t leader = Rig::tested;
inline constexpr std::uint8_t follower = Rig::neighbour;
inline constexpr std::uint8_t last = 2;
inline constexpr std::size_t muscles = 3;

/// The muscles differ by a fifth in heat transfer and a tenth in resistance; the firmware knows the
/// motion of all three together, and one cold resistance. Resistance does not tell temperature.
inline RigSettings bundle_board() {
  RigSettings s = rough_board();
  s.board.channels.push_back(s.board.channels[leader]);
  s.firmware.channels.push_back(s.firmware.channels[leader]);
  s.board.bundles = {{leader, follower, last}};
  add_bundle(s.firmware, {{leader, follower, last}});
  s.board.channels[follower].plant.heat_transfer_W_per_K *= 1.1;
  s.board.channels[last].plant.heat_transfer_W_per_K *= 0.9;
  s.board.channels[last].resistance_Ohm *= 1.1;
  for (std::size_t i = 0; i < muscles; ++i) {
    s.board.channels[i].temperature_coefficient_per_K = 0.0;
    s.board.channels[i].plant.moving_mass_kg *= static_cast<double>(muscles);
    ChannelSettings& channel = s.firmware.channels[i];
    channel.heater.temperature_coefficient_per_K = 0.0;
    channel.muscle.stiffness_N_per_m *= static_cast<double>(muscles);
    channel.muscle.damping_Ns_per_m *= static_cast<double>(muscles);
    channel.muscle.force_per_kelvin_N_per_K *= static_cast<double>(muscles);
    channel.muscle.moving_mass_kg *= static_cast<double>(muscles);
    channel.muscle_identified = true;
    channel.position.scaling = s.firmware.channels[leader].position.scaling;
  }
  return s;
}

/// The fixture of a test group.
struct BundleCase : Utest {
  Rig rig{bundle_board()};

  State state_of(std::uint8_t channel) { return rig.loop.channel(channel).state().state(); }
  const Snapshot& of(std::uint8_t channel) { return rig.loop.channel(channel).snapshot(); }
  host_sim::MuscleChannel& muscle_of(std::uint8_t channel) { return rig.board.channel(channel); }
  bool all(State state) {
    return state_of(leader) == state && state_of(follower) == state && state_of(last) == state;
  }
  bool all_off() {
    bool off = true;
    for (const std::uint8_t i : {leader, follower, last})
      off = off && !muscle_of(i).enable.high() && muscle_of(i).pwm.duty(rig.board.true_time()) == 0;
    return off;
  }

  void arm() {
    rig.boot();
    rig.arm();
    CHECK(all(State::armed));
    rig.run(0.2);
  }
  /// Renews the command at each tick.
  void hold(Verb verb, double value, double time_s) {
    const double from_s = rig.time_s();
    while (rig.time_s() - from_s < time_s) {
      rig.send(verb, value);
      rig.tick();
    }
  }
  /// Runs until the mode has ended by itself.
  bool completes_mode(Verb mode, double max_s) {
    CHECK(rig.answer_of(leader, mode) == Refusal::none);
    return rig.run_until(
        [&] {
          rig.send(Verb::renew);
          return state_of(leader) != State::active;
        },
        max_s);
  }
};

}  // namespace supercoil::test
