// The values before anything is measured, commanded or configured: no fault, nothing known, nothing
// on.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "board/applied_power.hpp"
#include "board/measurement.hpp"
#include "board/probe.hpp"
#include "loop/channel.hpp"
#include "loop/command.hpp"
#include "loop/feasibility.hpp"
#include "loop/loop.hpp"
#include "loop/overrun_policy.hpp"
#include "loop/playback.hpp"
#include "loop/promise.hpp"
#include "loop/self_test.hpp"
#include "loop/snapshot.hpp"
#include "supervisor/board_supervisor.hpp"
#include "supervisor/channel_inputs.hpp"
#include "supervisor/dither.hpp"
#include "supervisor/limiter.hpp"
#include "supervisor/small_signal.hpp"

using namespace supercoil;

TEST_GROUP(FirstValues){static void check_all_0(std::initializer_list<double> values){
    for (const double value
         : values) DOUBLES_EQUAL(0.0, value, 0.0);
}
static void check_absent(const board::Measured& measured) {
  check_all_0({measured.value, measured.age_s});
  CHECK_FALSE(measured.present);
  CHECK(measured.status == hal::Status::not_ready);
}
}
;

TEST(FirstValues, OfBoardInputsCauseNoFault) {
  const BoardInputs e;
  check_absent(e.supply);
  LONGS_EQUAL(0, e.skipped);
  UNSIGNED_LONGS_EQUAL(0, e.telemetry_heartbeats);
  DOUBLES_EQUAL(0.0, e.late_s, 0.0);
  CHECK(e.bus == hal::CanState::active);
  CHECK_TRUE(e.lines_ok);
  CHECK_FALSE(e.node_conflict || e.configuration_changed || e.self_test_failed);
}

TEST(FirstValues, OfAPlaybackAreEmpty) {
  const PlaybackStatus status;
  CHECK(status.state == PlaybackState::empty);
  LONGS_EQUAL(0, status.room);
  DOUBLES_EQUAL(0.0, status.buffered_s, 0.0);
}

TEST(FirstValues, OfChannelInputsCauseNoFault) {
  const AxisInputs axis;
  check_absent(axis.position);
  check_all_0({axis.sensor_m, axis.position_elapsed_s, axis.demanded_W, axis.from_position_K});
  CHECK_FALSE(axis.unanswered || axis.recalibrated || axis.expected_jumped);
  const HeaterInputs heater;
  check_absent(heater.current);
  check_all_0({heater.supply_V, heater.duty, heater.hottest_C, heater.applied_W, heater.measured_W,
               heater.from_resistance_K, heater.resistance_Ohm, heater.min_Ohm, heater.max_Ohm});
  CHECK_TRUE(heater.off && heater.devices_ok);
  CHECK_FALSE(heater.hot || heater.limited || heater.probed || heater.resistance_fresh ||
              heater.probe_failed);
  LONGS_EQUAL(0, heater.set_step);
  LONGS_EQUAL(-1, heater.read_back);
  const CommandInputs commands;
  CHECK_FALSE(commands.heating || commands.renewed || commands.damaged || commands.refused ||
              commands.obeyed);
}

TEST(FirstValues, OfABoardTickAllowNoHeating) {
  const BoardTick tick;
  LONGS_EQUAL(0, tick.time.count());
  DOUBLES_EQUAL(0.0, tick.supply_V, 0.0);
  CHECK_TRUE(tick.testing);
  CHECK_FALSE(tick.proven);
  CHECK(tick.fault == Fault::none && tick.air == nullptr);
  LONGS_EQUAL(1, tick.periods);
}

TEST(FirstValues, OfACommandRequestNothing) {
  const Command command;
  LONGS_EQUAL(0, command.channel);
  CHECK(command.verb == Verb::none && command.source == Source::local);
  DOUBLES_EQUAL(0.0, command.value, 0.0);
  UNSIGNED_LONGS_EQUAL(0, command.id);
  CHECK(command.tuned_controller == nullptr && command.tuned_estimator == nullptr);
  CHECK(command.tuning == nullptr);
  const Answer answer;
  CHECK(answer.refusal == Refusal::none);
  CHECK(std::isnan(answer.nearest));
  CHECK(std::isnan(Reply(Refusal::busy).nearest));
}

TEST(FirstValues, OfHealthAndTimingAreNeutral) {
  const Health health;
  UNSIGNED_LONGS_EQUAL(0, health.telemetry_heartbeats);
  CHECK(health.bus == hal::CanState::active);
  CHECK_FALSE(health.node_conflict || health.configuration_changed);
  const LoopTiming timing;
  CHECK(timing.late_ns == LoopTiming::none && timing.execution_ns == LoopTiming::none);
  CHECK(timing.overruns == 0 && timing.lost_rows == 0);
  const TickTime tick;
  LONGS_EQUAL(0, tick.late.count());
  LONGS_EQUAL(0, tick.execution.count());
  LONGS_EQUAL(0, NextTick{}.skipped);
}

TEST(FirstValues, OfASnapshotAreThoseOfAnIdleBoard) {
  const Snapshot s;
  LONGS_EQUAL(0, s.time.count());
  LONGS_EQUAL(0, s.channel);
  CHECK(s.state == State::disarmed && s.mode == Mode::rest && s.fault == Fault::none);
  CHECK(s.limited_by == LimitedBy::nothing && s.result == ModeResult::none);
  CHECK_FALSE(s.probing || s.trusted || s.limited || s.proof_off || s.slack);
  check_all_0({s.oscillation_period_s, s.reference, s.model_m, s.position_m, s.demanded_W,
               s.applied_W, s.duty, s.supply_V, s.current_A, s.resistance_Ohm, s.resistance_age_s,
               s.coldest_C, s.hottest_C, s.error_bound, s.bias_W, s.bias_deviation_W});
  CHECK(s.theta == control::Theta::Zero() && s.deviation == control::Theta::Zero());
  LONGS_EQUAL(0, s.controller);
  LONGS_EQUAL(0, s.multiplexed_selector);
  LONGS_EQUAL(0, s.identify_notes);
  DOUBLES_EQUAL(0.0, s.progress, 0.0);
  CHECK(s.margin_selector == Fault::none);
  check_all_0({s.margin.measured, s.margin.limit, s.margin.used()});
  CHECK_FALSE(s.margin.falls);
  CHECK_TRUE(s.margin.judged);
}

TEST(FirstValues, OfPowerAreZero) {
  const board::AppliedPower power;
  check_all_0({power.power_W, power.duty, power.dither_W});
  CHECK_FALSE(power.limited);
  const Limiter::Result allowed;
  DOUBLES_EQUAL(0.0, allowed.power_W, 0.0);
  CHECK(allowed.by == LimitedBy::nothing);
  const SelfTest::Lines lines;
  CHECK_FALSE(lines.heartbeat || lines.enable || lines.pulse);
  const board::Probe::Result probed;
  CHECK_FALSE(probed.ended);
  DOUBLES_EQUAL(0.0, probed.resistance_Ohm, 0.0);
}

TEST(FirstValues, OfPlansAreNeutral) {
  const Dither dither;
  LONGS_EQUAL(1, dither.half_steps);
  DOUBLES_EQUAL(0.0, dither.amplitude_W, 0.0);
  CHECK_FALSE(std::isfinite(dither.decided_s));
  const ProofPlan plan;
  check_all_0({plan.safe_W, plan.provable_W});
  const SmallSignal::Settings small;
  check_all_0({small.hold_W, small.settle_s, small.noise_m});
  DOUBLES_EQUAL(1000.0, small.rate_Hz, 0.0);
  DOUBLES_EQUAL(0.01, small.step_s, 0.0);
  const Proof::Input input;
  check_all_0(
      {input.power_W, input.dither_W, input.position_m, input.hottest_K, input.warmer_air_K});
  LONGS_EQUAL(1, input.periods);
  CHECK_FALSE(input.present || input.heating);
  const FirstMotion motion;
  check_all_0({motion.middle_m, motion.amplitude_m, motion.period_s, motion.end_s()});
  const Promise promise;
  check_all_0({promise.noise_m, promise.probe_m, promise.dither_m, promise.pwm_m,
               promise.unexplained_m, promise.error_m()});
}

TEST(FirstValues, OfCapabilitiesAreZero) {
  const Feasibility f;
  check_all_0({f.max_W, f.held_W, f.travel_m, f.rise_s, f.fall_s, f.half_travel_period_s,
               f.air_shift_m, f.armable_s});
  CHECK(f.held_by == LimitedBy::maximum);
  CHECK_TRUE(f.rest_seen);
  CHECK(f.steps.empty());
  const FeasibleSteps steps;
  check_all_0({steps.up_m, steps.down_m});
  CHECK_FALSE(steps.shaped);
}

TEST(FirstValues, OfAnUnstartedSmallSignalAreNoMotion) {
  SmallSignal measuring;
  CHECK_FALSE(measuring.running());
  check_all_0({measuring.power_W(), measuring.response_ratio()});
  // Without a start it waits for nothing, whatever is measured.
  for (int i = 0; i < 100; ++i)
    CHECK_FALSE(measuring.step(0.01, 1.0));
  DOUBLES_EQUAL(0.0, measuring.power_W(), 0.0);
}
