// Muscles that pull together, each with its own heater.
#include "loop/bundle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "loop/support/bundle_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(Bundle, BundleCase){};

TEST(Bundle, EveryHeaterGetsTheSamePower) {
  arm();
  hold(Verb::power, 2.0, 5.0);
  for (const std::uint8_t i : {leader, follower, last}) {
    DOUBLES_EQUAL(2.0, muscle_of(i).true_power_W(), 0.03);
    DOUBLES_EQUAL(2.0, of(i).demanded_W, 0.0);
  }
  CHECK(of(leader).mode == Mode::power);
  CHECK(of(follower).mode == Mode::bundle && of(last).mode == Mode::bundle);
  CHECK(all(State::active));
}

TEST(Bundle, FollowsAPositionWithTemperaturesInTheirIntervals) {
  arm();
  hold(Verb::position, 0.010, 20.0);
  DOUBLES_EQUAL(0.010, muscle_of(leader).position_m(), 50e-6);
  DOUBLES_EQUAL(muscle_of(leader).position_m(), muscle_of(last).position_m(), 0.0);
  CHECK_COMPARE(muscle_of(last).temperature_rise_K(), >,
                1.15 * muscle_of(follower).temperature_rise_K());
  CHECK_FALSE(rig.interval_missed);
  CHECK(all(State::active));
}

TEST(Bundle, ArmsRestsAndCoolsAsOne) {
  arm();
  for (const std::uint8_t addressed : {leader, follower}) {
    hold(Verb::position, 0.005, 0.5);
    CHECK(all(State::active));
    CHECK(rig.answer_of(addressed, Verb::rest) == Refusal::none);
    CHECK(all(State::armed));
    CHECK(of(last).mode == Mode::rest);
  }
  hold(Verb::position, 0.005, 0.5);
  CHECK(rig.answer_of(follower, Verb::disarm) == Refusal::none);
  CHECK(all(State::disarmed) && all_off());
  CHECK(rig.answer_of(follower, Verb::arm) == Refusal::none);
  CHECK(all(State::armed));
}

TEST(Bundle, ArmsOnlyWhenEveryMuscleMay) {
  rig.boot();
  muscle_of(last).current.set(host_sim::ConverterFaults{.silent = true});
  rig.run(0.1);
  CHECK(rig.answer_of(leader, Verb::arm) != Refusal::none);
  CHECK(all(State::disarmed) || state_of(last) == State::fault);
  CHECK_FALSE(state_of(leader) == State::armed);
}

TEST(Bundle, OnlyTheLeaderAcceptsHeatingCommands) {
  arm();
  for (const Verb verb : {Verb::power, Verb::position, Verb::identify, Verb::calibrate})
    CHECK(rig.answer_of(follower, verb) == Refusal::wrong_state);
  CHECK(rig.answer_of(follower, Verb::scale, 0.005) == Refusal::unsuitable);
  CHECK(all(State::armed));
  hold(Verb::position, 0.005, 0.5);
  CHECK(rig.answer_of(follower, Verb::power, 1.0) == Refusal::wrong_state);
  CHECK(rig.answer_of(follower, Verb::renew) == Refusal::wrong_state);
  CHECK(all(State::active));
  // When the leader's command is no longer renewed, all stop.
  rig.run(0.5);
  CHECK(all(State::fault) && all_off());
  CHECK(rig.fault() == Fault::command_timeout);
}

TEST(Bundle, TheLowestPowerLimitAppliesToEveryMuscle) {
  arm();
  rig.loop.channel(last).allow_power(1.5);
  hold(Verb::power, 2.5, 2.0);
  for (const std::uint8_t i : {leader, follower, last})
    DOUBLES_EQUAL(1.5, muscle_of(i).true_power_W(), 0.03);
  // The leader reports the reason, although its own heater could give the power.
  CHECK(of(last).limited_by == LimitedBy::maximum);
  CHECK(of(leader).limited && of(leader).limited_by == LimitedBy::maximum);
  CHECK_FALSE(of(follower).limited);
  rig.loop.channel(leader).allow_power(1.0);
  hold(Verb::power, 2.5, 0.5);
  std::array<double, 3> peaks_W{};  // peaks, because a dither lowers it
  for (int tick = 0; tick < 1000; ++tick) {
    hold(Verb::power, 2.5, rig.period_s());
    for (const std::uint8_t i : {leader, follower, last})
      peaks_W.at(i) = std::max(peaks_W.at(i), muscle_of(i).true_power_W());
  }
  for (const double peak_W : peaks_W)
    DOUBLES_EQUAL(1.0, peak_W, 0.03);
}

TEST(Bundle, AntiWindupUsesTheLowestPowerLimit) {
  const auto demanded_W = [](std::uint8_t limited, std::uint8_t also) {
    Rig fresh(bundle_board());
    fresh.boot();
    fresh.arm();
    fresh.loop.channel(limited).allow_power(1.2);
    fresh.loop.channel(also).allow_power(1.2);
    // Further than 1.2 W can hold: the integral must not wind up.
    fresh.run_until([&] { return fresh.send(Verb::position, 0.020), false; }, 30.0);
    CHECK(fresh.snapshot().limited);
    return fresh.snapshot().demanded_W;
  };
  // A dither makes room in other ticks when another heater is the weakest.
  DOUBLES_EQUAL(demanded_W(leader, last), demanded_W(last, last), 0.05);
}

TEST(Bundle, AFaultOfOneMuscleCoolsAll) {
  for (const std::uint8_t broken : {leader, last}) {
    Rig fresh(bundle_board());
    fresh.boot();
    fresh.arm();
    fresh.run(0.2);
    fresh.board.channel(broken).faults.wire_open = true;
    const bool found = fresh.run_until(
        [&] {
          fresh.send(Verb::power, 2.0);
          return fresh.state() == State::fault;
        },
        1.0);
    CHECK(found);
    for (std::size_t i = 0; i < muscles; ++i) {
      CHECK(fresh.loop.channel(i).state().first_cause() == Fault::heater_open);
      CHECK(!fresh.board.channel(i).enable.high());
    }
    // Nor may a muscle be reset while another one still has the cause.
    fresh.run(1.0);
    fresh.answer_of(follower, Verb::reset);
    CHECK(fresh.state() == State::disarmed || fresh.state() == State::fault);
    fresh.board.channel(broken).faults.wire_open = false;
    fresh.run(1.0);
    fresh.answer_of(follower, Verb::reset);
    fresh.run(0.1);
    for (std::size_t i = 0; i < muscles; ++i)
      CHECK(fresh.loop.channel(i).state().state() == State::disarmed);
  }
}

TEST(Bundle, CalibratesOneMuscleAfterTheOther) {
  arm();
  CHECK(rig.answer_of(leader, Verb::calibrate) == Refusal::none);
  bool alone = true;
  float progress = 0.0F;
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::renew);
        const int heating = (of(follower).mode == Mode::calibrate ? 1 : 0) +
                            (of(last).mode == Mode::calibrate ? 1 : 0);
        alone = alone && heating <= 1;
        const bool active = state_of(leader) == State::active;
        if (active) {
          CHECK(of(leader).progress >= progress - 1e-3F);
          progress = std::max(progress, of(leader).progress);
          CHECK_COMPARE(progress, <=, 1.0F);
          CHECK(of(leader).result == ModeResult::running);
        }
        return !active;
      },
      400.0));
  CHECK(alone && all(State::armed));
  CHECK_COMPARE(progress, >, 0.66F);
  // Within the errors of the rough board's senses.
  for (const std::uint8_t i : {leader, follower, last}) {
    const double cold_Ohm = rig.loop.channel(i).known(known_cold_resistance);
    DOUBLES_EQUAL(1.0, cold_Ohm / muscle_of(i).settings().resistance_Ohm, 0.03);
  }
  // One sensor, one zero.
  for (const std::uint8_t i : {follower, last}) {
    DOUBLES_EQUAL(rig.loop.channel(leader).known(known_position_offset),
                  rig.loop.channel(i).known(known_position_offset), 0.0);
  }
}

TEST(Bundle, LeaderReportsAnotherMusclesFailedCalibration) {
  arm();
  CHECK(rig.answer_of(leader, Verb::calibrate) == Refusal::none);
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::renew);
        return of(follower).mode == Mode::calibrate;
      },
      200.0));
  // Somebody moves the load while the zero is taken.
  rig.before_tick = [&] {
    host_sim::MuscleChannelSettings pulled = muscle_of(leader).settings();
    pulled.load_N = -0.05 * rig.time_s();
    muscle_of(leader).set(pulled);
  };
  rig.run_until(
      [&] {
        rig.send(Verb::renew);
        return state_of(leader) != State::active;
      },
      200.0);
  CHECK(of(follower).result == ModeResult::moved);
  CHECK(of(leader).result == ModeResult::moved);
  CHECK(of(last).result == ModeResult::none);
}

TEST(Bundle, InterruptedCalibrateIsNotReportedAsFound) {
  const auto calibrates_second = [](Rig& fresh) {
    fresh.boot();
    fresh.arm();
    fresh.run(0.2);
    CHECK(fresh.answer_of(leader, Verb::calibrate) == Refusal::none);
    CHECK(fresh.run_until(
        [&] {
          fresh.send(Verb::renew);
          return fresh.loop.channel(follower).snapshot().mode == Mode::calibrate;
        },
        200.0));
  };
  // A command to any node ends it, even to one that waits for its turn.
  for (const std::uint8_t addressed : {leader, follower, last}) {
    Rig fresh(bundle_board());
    calibrates_second(fresh);
    fresh.loop.send({addressed, Verb::rest, 0.0});
    fresh.run(0.1);
    CHECK(fresh.snapshot().result == ModeResult::interrupted);
    for (std::size_t i = 0; i < muscles; ++i)
      CHECK(fresh.loop.channel(i).state().state() == State::armed);
  }
  Rig broken(bundle_board());
  calibrates_second(broken);
  CHECK(broken.answer_of(leader, Verb::disarm) == Refusal::none);
  CHECK(broken.snapshot().result == ModeResult::interrupted);
}

TEST(Bundle, IdentifyRespectsTheLowestPowerLimit) {
  arm();
  rig.loop.channel(last).allow_power(2.0);
  CHECK(rig.answer_of(leader, Verb::identify) == Refusal::none);
  double demanded_W = 0.0;
  CHECK(rig.run_until(
      [&] {
        rig.send(Verb::renew);
        demanded_W = std::max(demanded_W, of(leader).demanded_W);
        return state_of(leader) != State::active;
      },
      400.0));
  CHECK(of(leader).result == ModeResult::found);
  CHECK_COMPARE(demanded_W, <=, 2.0);
  CHECK_COMPARE(demanded_W, >, 1.5);
}

TEST(Bundle, DitherStaysBelowTheLowestPowerLimit) {
  arm();
  rig.loop.channel(last).allow_power(1.5);
  rig.run(0.01);
  // The demand is more than the weakest may have: the dither has room below that limit.
  double max_W = 0.0;
  double apart_W = 0.0;
  const double from_s = rig.time_s();
  while (rig.time_s() - from_s < 60.0) {
    rig.send(Verb::power, 2.5);
    rig.tick();
    for (const std::uint8_t i : {leader, follower, last}) {
      max_W = std::max(max_W, of(i).applied_W);
      apart_W = std::max(apart_W, std::abs(of(i).applied_W - of(leader).applied_W));
    }
  }
  CHECK_COMPARE(max_W, <, 1.52);
  CHECK_COMPARE(apart_W, <, 0.02);
  CHECK(all(State::active));
  CHECK(of(leader).limited_by != LimitedBy::unproven);
}

TEST(Bundle, IdentifiesTheBundleAsOneMuscle) {
  arm();
  CHECK(completes_mode(Verb::identify, 400.0));
  CHECK(of(leader).result == ModeResult::found);
  CHECK(all(State::armed));
  double gain_m_per_W = 0.0;
  for (const std::uint8_t i : {leader, follower, last}) {
    const control::PhysicalParameters& p = muscle_of(i).settings().plant;
    gain_m_per_W +=
        p.force_per_kelvin_N_per_K / (p.heat_transfer_W_per_K * 3.0 * p.stiffness_N_per_m);
  }
  for (const std::uint8_t i : {leader, follower, last}) {
    const Channel& channel = rig.loop.channel(i);
    const double found_m_per_W = channel.known(5) / (channel.known(1) * channel.known(2));
    DOUBLES_EQUAL(1.0, found_m_per_W / gain_m_per_W, 0.03);
  }
  hold(Verb::position, 0.010, 60.0);
  CHECK(all(State::active));
  CHECK_FALSE(rig.interval_missed);
}

TEST(Bundle, OneSensorScaleAppliesToEveryMuscle) {
  arm();
  hold(Verb::power, 1.5, 10.0);
  CHECK(rig.answer_of(leader, Verb::scale, 2.0 * of(leader).position_m) == Refusal::none);
  rig.send(Verb::power, 1.5);
  rig.tick();
  for (const std::uint8_t i : {leader, follower, last}) {
    DOUBLES_EQUAL(2.0, rig.loop.channel(i).known(known_position_scale), 0.01);
    DOUBLES_EQUAL(2.0 * muscle_of(leader).position_m(), of(i).position_m, 100e-6);
  }
  hold(Verb::power, 1.5, 1.0);
  CHECK(all(State::active));
}

TEST(Bundle, ComparesEachMusclesSensesAtOneCommonPower) {
  constexpr double current_gain = 0.9;  // measured over true
  constexpr double supply_V = 12.0;
  RigSettings settings = bundle_board();
  settings.board.channels[follower].current.low /= current_gain;
  settings.board.channels[follower].current.high /= current_gain;
  Rig miscalibrated(settings);
  miscalibrated.boot();
  miscalibrated.arm();
  miscalibrated.run(0.2);
  double charge_As = 0.0;
  const auto hold_for = [&](Verb verb, double value, double time_s) {
    charge_As = 0.0;
    for (int i = 0; i < std::lround(time_s / miscalibrated.period_s()); ++i) {
      miscalibrated.send(verb, value);
      miscalibrated.tick();
      charge_As += miscalibrated.period_s() * miscalibrated.board.channel(follower).true_power_W() /
                   supply_V;
    }
  };
  for (const double power_W : {0.5, 1.0}) {
    hold_for(Verb::power, power_W, 2.5);
    CHECK(miscalibrated.answer_of(follower, Verb::compare_supply, supply_V) == Refusal::none);
    CHECK(miscalibrated.answer_of(follower, Verb::compare_current, charge_As / 2.5) ==
          Refusal::none);
  }
  DOUBLES_EQUAL(1.0 / current_gain, miscalibrated.loop.channel(follower).senses().current_gain,
                0.02);
  CHECK_FALSE(miscalibrated.loop.channel(leader).senses().compared());
  // A change of power restarts the average, and a controller changes the power all the time.
  hold_for(Verb::power, 1.8, 0.1);
  CHECK(miscalibrated.answer_of(follower, Verb::compare_supply, supply_V) == Refusal::not_ready);
  hold_for(Verb::position, 0.005, 3.0);
  CHECK(miscalibrated.answer_of(follower, Verb::compare_supply, supply_V) == Refusal::not_ready);
}

TEST(Bundle, SharedMotionDoesNotYieldATimeConstant) {
  RigSettings settings = bundle_board();
  for (ChannelSettings& channel : settings.firmware.channels) {
    channel.thermal.mass_error_ratio = 0.1;
    CHECK(channel.thermal.weighed());
  }
  Rig weighed(settings);
  weighed.boot();
  weighed.arm();
  weighed.run(0.2);
  CHECK(weighed.answer_of(leader, Verb::identify) == Refusal::none);
  weighed.run_until(
      [&] {
        weighed.send(Verb::renew);
        return weighed.state() != State::active;
      },
      400.0);
  CHECK(weighed.snapshot().result == ModeResult::found);
  CHECK_FALSE(weighed.interval_missed);
  const board::ThermalFacts& facts = weighed.loop.channel(leader).axis().heater().facts();
  DOUBLES_EQUAL(0.0, facts.time_constant_s, 0.0);
}
