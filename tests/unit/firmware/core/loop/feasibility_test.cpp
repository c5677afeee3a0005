// The predictions for a muscle agree with its model.
#include "loop/feasibility.hpp"

#include <cmath>
#include <numbers>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/reference_shaper.hpp"

using namespace supercoil;

TEST_GROUP(Feasibility) {
  BoardSettings board;
  ChannelSettings& channel = board.channels[0];

  Feasibility found() const {
    return feasibility(channel, board);
  }
  double gain_m_per_W() const {
    return channel.muscle.dc_gain_m_per_W();
  }
  /// Seconds until the temperature rise moves the muscle from its position to the target.
  double time_to(double target_m, double& position_m, double power_W) const {
    constexpr double step_s = 1e-5;
    const double tau_s = channel.muscle.thermal_mass_J_per_K / channel.muscle.heat_transfer_W_per_K;
    const bool rises = target_m > position_m;
    double time_s = 0.0;
    for (; rises == (target_m > position_m); time_s += step_s)
      position_m += (gain_m_per_W() * power_W - load_m(channel) - position_m) * step_s / tau_s;
    return time_s;
  }
  /// At its extremes the sine must need exactly full power or none.
  void check_fastest_sine(const Feasibility& f) const {
    const double tau_s = channel.muscle.thermal_mass_J_per_K / channel.muscle.heat_transfer_W_per_K;
    const double omega = 2.0 * std::numbers::pi / f.half_travel_period_s;
    double min_W = INFINITY;
    double max_W = 0.0;
    for (int i = 0; i < 100000; ++i) {
      const double phase = 2e-5 * std::numbers::pi * i;
      const double position_m = f.travel_m * (0.5 + 0.25 * std::sin(phase));
      const double velocity = f.travel_m * 0.25 * omega * std::cos(phase);
      const double power_W = (position_m + load_m(channel) + tau_s * velocity) / gain_m_per_W();
      min_W = std::fmin(min_W, power_W);
      max_W = std::fmax(max_W, power_W);
    }
    CHECK(min_W > -1e-6);
    CHECK(max_W < f.max_W + 1e-6);
    CHECK(min_W < 1e-6 || max_W > f.max_W - 1e-6);
  }
  /// Whether a step through the controller's model stays within the available power.
  bool is_feasible(double from_m, double to_m, double max_W) const {
    constexpr double step_s = 1e-4;
    const control::ControllerSettings& controller = channel.controllers[0];
    const control::ReferenceShaper shaper(
        controller.model,
        {control::theta_from(channel.muscle), gain_m_per_W(), channel.muscle.moving_mass_kg});
    control::ReferenceModel<double> model(controller.model, step_s);
    model.set({from_m, 0.0, 0.0});
    for (int i = 0; i < 200000; ++i) {
      if (shaper.step(to_m, model.motion(), {0.0, max_W}).infeasible !=
          control::Infeasible::nothing)
        return false;
      model.step(to_m);
    }
    return true;
  }
};

TEST(Feasibility, TheHeldPowerIsThatLeftByDerating) {
  channel.supervision.proof_of_response = false;
  const Feasibility f = found();
  CHECK(f.held_by == LimitedBy::temperature);
  const double eta = channel.thermal.bounds.min_transfer_W_per_K;
  const double hottest_C = channel.thermal.air.warmest_C +
                           f.held_W * power_bounds(channel, board).true_over_measured().max / eta;
  DOUBLES_EQUAL(f.held_W, Limiter(channel.limiter, 0.001).max_W(hottest_C), 1e-9);
  DOUBLES_EQUAL(gain_m_per_W() * f.held_W, f.travel_m, 1e-12);
}

TEST(Feasibility, WithoutDeratingTheMaximumPowerLimits) {
  channel.supervision.proof_of_response = false;
  channel.limiter.max_W = 0.5;
  const Feasibility f = found();
  CHECK(f.held_by == LimitedBy::maximum);
  DOUBLES_EQUAL(0.5, f.held_W, 1e-12);
}

TEST(Feasibility, ALowSupplyLimitsThePower) {
  channel.heater.cold_resistance_Ohm = 50.0;
  DOUBLES_EQUAL(10.8 * 10.8 / 50.0, found().max_W, 1e-12);
}

TEST(Feasibility, ProofOfResponseLowersTheHeldPower) {
  const Feasibility f = found();
  CHECK(f.held_by == LimitedBy::unproven);
  CHECK(f.held_W < found().max_W);
}

TEST(Feasibility, RiseAndFallMatchTheModel) {
  const Feasibility f = found();
  double position_m = 0.1 * f.travel_m;
  DOUBLES_EQUAL(time_to(0.9 * f.travel_m, position_m, f.max_W), f.rise_s, 1e-3);
  DOUBLES_EQUAL(time_to(0.1 * f.travel_m, position_m, 0.0), f.fall_s, 1e-3);
}

TEST(Feasibility, TheFastestSineNeedsAllThePowerOrNone) {
  check_fastest_sine(found());
}

/// For a muscle with a load that only a simulation knows.
TEST(Feasibility, ALoadCostsPowerToHoldAndSpeedsUpTheFall) {
  channel.supervision.proof_of_response = false;
  const Feasibility free = found();
  channel.simulated.load_N = 0.1;
  const Feasibility f = found();
  DOUBLES_EQUAL(free.travel_m - 0.1 / channel.muscle.stiffness_N_per_m, f.travel_m, 1e-12);
  double position_m = 0.1 * f.travel_m;
  DOUBLES_EQUAL(time_to(0.9 * f.travel_m, position_m, f.max_W), f.rise_s, 1e-3);
  DOUBLES_EQUAL(time_to(0.1 * f.travel_m, position_m, 0.0), f.fall_s, 1e-3);
  CHECK(f.fall_s < free.fall_s);
  check_fastest_sine(f);
  channel.controllers[0].model = control::poles_model({9.0, 9.0, 9.0});
  CHECK(found().steps[0]->up_m < free.steps[0]->up_m);
  // A load that lifts holds the muscle up, so that it never falls to the target.
  channel.simulated.load_N = -0.2;
  CHECK_TRUE(std::isinf(found().fall_s));
  CHECK_TRUE(std::isinf(found().half_travel_period_s));
}

TEST(Feasibility, ThroughASlowModelAFullTravelStepIsFeasible) {
  const Feasibility f = found();
  DOUBLES_EQUAL(f.travel_m, f.steps[0]->up_m, 0.0);
  CHECK(is_feasible(0.0, f.travel_m, f.max_W));
}

TEST(Feasibility, LargerStepsThanReportedAreInfeasible) {
  channel.controllers[0].model = control::poles_model({9.0, 9.0, 9.0});
  const Feasibility f = found();
  const FeasibleSteps steps = f.steps[0].value();
  CHECK(is_feasible(0.0, 0.99 * steps.up_m, f.max_W));
  CHECK_FALSE(is_feasible(0.0, 1.02 * steps.up_m, f.max_W));
  CHECK(is_feasible(f.travel_m, f.travel_m - 0.99 * steps.down_m, f.max_W));
  CHECK_FALSE(is_feasible(f.travel_m, f.travel_m - 1.02 * steps.down_m, f.max_W));
}

TEST(Feasibility, OpenLoopHasNoFeasibleSteps) {
  channel.controllers[0].kind = control::ControllerKind::power;
  CHECK_FALSE(found().steps[0].has_value());
}

TEST(Feasibility, MayBeArmedAfterTheSlowestCooling) {
  const board::ThermalSettings& t = channel.thermal;
  control::RiseIntervalObserver interval(t.bounds, 0.001);
  interval.reset(t.boot_rise_K);
  double time_s = 0.0;
  for (; t.air.warmest_C + interval.max_K() >= channel.limiter.derate_from_C; time_s += 0.001)
    interval.step(0.0, 0.0);
  DOUBLES_EQUAL(time_s, found().armable_s, 0.002);
}

TEST(Feasibility, TheSensorMustCoverTheRestPositionInTheColdestAir) {
  channel.thermal.air = {.warmest_C = 30.0, .coldest_C = 15.0};
  channel.supervision.min_position_m = -0.0081;
  const Feasibility f = found();
  DOUBLES_EQUAL(15.0 * 0.0086 / 16.0, f.air_shift_m, 1e-9);
  CHECK(f.rest_seen);
  channel.supervision.min_position_m = -0.0080;
  CHECK_FALSE(found().rest_seen);
  // A sensor that reads half the motion and shows 2 mm at rest.
  channel.calibration.position_offset_m = 0.002;
  channel.calibration.position_scale = 2.0;
  channel.supervision.min_position_m = -0.0021;
  CHECK(found().rest_seen);
  channel.supervision.min_position_m = -0.0020;
  CHECK_FALSE(found().rest_seen);
}

TEST(Feasibility, TheColdestAirLowersTheHeldTravel) {
  channel.supervision.proof_of_response = false;
  channel.thermal.air = {.warmest_C = 30.0, .coldest_C = 20.0};
  const Feasibility f = found();
  DOUBLES_EQUAL(f.travel_m - f.air_shift_m, f.cold_travel_m, 1e-12);
  // With a sensor that reads cold air, the muscle gets as much as where it is never warmer.
  channel.thermal.air.error_K = 1.0;
  const Feasibility measured = found();
  channel.thermal.air = {.warmest_C = 22.0, .coldest_C = 22.0};
  DOUBLES_EQUAL(found().travel_m - measured.air_shift_m, measured.cold_travel_m, 1e-12);
  CHECK(measured.cold_travel_m > f.cold_travel_m);
  DOUBLES_EQUAL(f.travel_m, measured.travel_m, 0.0);
  // With such a wide span nothing is left.
  channel.thermal.air = {.warmest_C = 70.0, .coldest_C = -30.0};
  DOUBLES_EQUAL(0.0, found().cold_travel_m, 0.0);
}

TEST(Feasibility, PullIsThatOfTheWorstCooledMuscle) {
  channel.thermal.air = {.warmest_C = 30.0, .coldest_C = 15.0};
  channel.thermal.bounds.min_transfer_W_per_K = 0.045;
  channel.muscle.force_per_kelvin_N_per_K = 0.01;
  DOUBLES_EQUAL(0.01 * 0.9 / 0.045, hottest_pull_N(channel, 0.9), 1e-12);
  // Not hotter than it may become, above the coldest air.
  channel.supervision.trip_C = 30.0;
  DOUBLES_EQUAL(0.01 * (30.0 - 15.0), hottest_pull_N(channel, 0.9), 1e-12);
}

TEST(Feasibility, MaxPowerIsThatAtTheLowestSupply) {
  channel.supervision.proof_of_response = false;
  board.supervision.min_supply_V = 10.0;
  board.supervision.max_supply_V = 14.0;
  channel.heater.cold_resistance_Ohm = 50.0;
  DOUBLES_EQUAL(10.0 * 10.0 / 50.0, found().max_W, 1e-12);
  channel.heater.cold_resistance_Ohm = 10.0;
  DOUBLES_EQUAL(channel.limiter.max_W, found().max_W, 0.0);
}
