// What the muscles of a bundle know of each other, and what their leader relies on.
#include <algorithm>

#include "loop/support/bundle_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

void begin_bundle(Rig& rig) {
  rig.boot();
  rig.arm();
  rig.run(0.2);
}

void hold_bundle(Rig& rig, double power_W, double time_s) {
  rig.run_until([&] { return rig.send(Verb::power, power_W), false; }, time_s);
}

bool bundle_completes(Rig& rig, Verb mode) {
  CHECK(rig.answer_of(leader, mode) == Refusal::none);
  return rig.run_until(
      [&] {
        rig.send(Verb::renew);
        return rig.state() != State::active;
      },
      400.0);
}

detectors::Margin motion_of(const Rig& rig, std::uint8_t channel) {
  return rig.loop.channel(channel).verdict().margin(Fault::heater_not_responding);
}

/// Time to a fault once the position freezes at this moment; the leader's proof is that of all.
double lost_contact_found_s(RigSettings settings, double moment_s) {
  for (ChannelSettings& channel : settings.firmware.channels) {
    channel.supervision.energy_J = 1e6;
    channel.supervision.responding_window_s = 600.0;  // the proof alone is tested
  }
  Rig rig(settings);
  begin_bundle(rig);
  hold_bundle(rig, 2.5, moment_s);
  CHECK(rig.state() == State::active);
  rig.board.channel(leader).faults.slack = true;
  const double from_s = rig.time_s();
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::power, 2.5);
        return rig.state() == State::fault;
      },
      60.0));
  CHECK(rig.fault() == Fault::heater_not_responding);
  return rig.time_s() - from_s;
}

/// The mean over moments between two dithers.
double lost_contact_found_s(const RigSettings& settings) {
  double sum_s = 0.0;
  for (const double moment_s : {20.0, 20.2, 20.4, 20.6, 20.8})
    sum_s += lost_contact_found_s(settings, moment_s);
  return 0.2 * sum_s;
}

/// Senses that were compared with a meter.
RigSettings compared_board() {
  RigSettings settings = bundle_board();
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.senses.error_ratio = 0.02;
  return settings;
}

}  // namespace

TEST_GROUP_BASE(BundleKnowledge, BundleCase){};

TEST(BundleKnowledge, HottestMuscleSetsTheTimeToProveContact) {
  RigSettings settings = compared_board();
  const double usual_s = lost_contact_found_s(settings);
  settings.firmware.channels[last].thermal.bounds.min_transfer_W_per_K *= 0.7;
  CHECK_COMPARE(lost_contact_found_s(settings), <, usual_s - 0.1);
}

TEST(BundleKnowledge, WidestPowerBoundsSetTheTimeToProveContact) {
  RigSettings settings = compared_board();
  settings.firmware.channels[last].senses = {};
  const double one_s = lost_contact_found_s(settings);
  settings.firmware.channels[leader].senses = {};
  DOUBLES_EQUAL(lost_contact_found_s(settings), one_s, 0.05);
}

TEST(BundleKnowledge, ZeroIsTakenWhenTheSlowestMuscleIsCold) {
  RigSettings settings = bundle_board();
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.thermal.boot_rise_K = 20.0;  // otherwise it waits for a minute
  board::ThermalSettings& slow = settings.firmware.channels[last].thermal;
  slow.bounds.max_mass_J_per_K *= 1.5;
  Rig fresh(settings);
  begin_bundle(fresh);
  hold_bundle(fresh, 2.0, 5.0);
  CHECK(fresh.answer_of(leader, Verb::rest) == Refusal::none);
  CHECK(fresh.answer_of(leader, Verb::calibrate) == Refusal::none);
  CHECK(fresh.run_until(
      [&] {
        fresh.send(Verb::renew);
        return fresh.loop.channel(follower).snapshot().mode == Mode::calibrate;
      },
      300.0));
  CHECK_COMPARE(fresh.loop.channel(last).snapshot().hottest_C - slow.air.warmest_C, <, 1.1);
}

TEST(BundleKnowledge, EachHeaterKeepsItsColdResistance) {
  RigSettings settings = bundle_board();
  settings.firmware.channels[last].calibration.cold_resistance_Ohm = 11.0;
  Rig fresh(settings);
  begin_bundle(fresh);
  hold_bundle(fresh, 1.5, 10.0);
  CHECK(fresh.answer_of(leader, Verb::scale, 1.1 * fresh.snapshot().position_m) == Refusal::none);
  fresh.run_ticks(2);
  DOUBLES_EQUAL(1.1, fresh.loop.channel(last).known(known_position_scale), 0.01);
  DOUBLES_EQUAL(11.0, fresh.loop.channel(last).known(known_cold_resistance), 0.0);
}

TEST(BundleKnowledge, ANewScaleDoesNotCountAsMotion) {
  arm();
  hold(Verb::power, 1.5, 45.0);
  CHECK(rig.answer_of(leader, Verb::scale, 2.0 * of(leader).position_m) == Refusal::none);
  hold(Verb::power, 1.5, 0.01);
  for (const std::uint8_t i : {leader, follower, last})
    CHECK_COMPARE(motion_of(rig, i).measured, <, 0.5e-3);
}

TEST(BundleKnowledge, EveryMuscleExpectsWhatIdentifyFound) {
  RigSettings settings = bundle_board();
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.muscle.stiffness_N_per_m *= 0.7;
  Rig fresh(settings);
  begin_bundle(fresh);
  const auto metres_per_K = [&](std::uint8_t channel) {
    return fresh.loop.channel(channel).axis().heater().heat().metres_per_K();
  };
  const double believed = metres_per_K(leader);
  CHECK(bundle_completes(fresh, Verb::identify));
  CHECK(fresh.snapshot().result == ModeResult::found);
  fresh.run_ticks(3);
  CHECK_COMPARE(metres_per_K(leader), <, 0.8 * believed);
  for (const std::uint8_t i : {leader, follower, last}) {
    DOUBLES_EQUAL(metres_per_K(leader), metres_per_K(i), 0.0);
    CHECK_COMPARE(motion_of(fresh, i).measured, <, 1e-4);
    CHECK_FALSE(motion_of(fresh, i).judged);
  }
}

TEST(BundleKnowledge, IdentifyRespectsTheDeratedLimitOfAHotMuscle) {
  RigSettings settings = bundle_board();
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.thermal.boot_rise_K = 20.0;  // otherwise it waits for a minute
  settings.firmware.channels[last].limiter.derate_from_C = 50.0;
  settings.firmware.channels[last].limiter.derate_to_C = 90.0;
  Rig fresh(settings);
  begin_bundle(fresh);
  CHECK(fresh.answer_of(leader, Verb::identify) == Refusal::none);
  const Limiter& limiter = fresh.loop.channel(last).axis().heater().limiter();
  double too_much_W = -1.0;
  double hottest_C = 0.0;
  fresh.run_until(
      [&] {
        fresh.send(Verb::renew);
        const double last_C = fresh.loop.channel(last).snapshot().hottest_C;
        hottest_C = std::max(hottest_C, last_C);
        too_much_W = std::max(too_much_W, fresh.snapshot().demanded_W - limiter.max_W(last_C));
        return false;
      },
      60.0);
  CHECK_COMPARE(hottest_C, >, 60.0);
  CHECK_COMPARE(too_much_W, <, 0.02);
}
