// One muscle that lifts an arm; only the arm's weight draws it back.
#include "loop/hanging_arm.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <CppUTest/TestHarness.h>

#include "loop/feasibility.hpp"

using namespace supercoil;

namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double lever_m = 0.015;
constexpr double weight_Nm = 0.005;
constexpr double hangs_at_rad = -45.0 * rad_per_deg;

}  // namespace

TEST_GROUP(HangingArm) {
  BoardSettings board;
  ChannelSettings& channel = board.channels[0];
  double own_N_per_m = 16.0;

  void setup() override {
    channel.joint = {.direction = 1,
                     .lever = control::Lever(lever_m),
                     .weight_Nm = weight_Nm,
                     .hangs_at_rad = hangs_at_rad};
    channel.muscle.stiffness_N_per_m =
        own_N_per_m + weight_Nm * std::cos(hangs_at_rad) / (lever_m * lever_m);
    channel.supervision.max_travel_m = 60.0 * rad_per_deg * lever_m;
    channel.supervision.proof_of_response = false;
  }
  HangingArm arm() const {
    return {channel.joint, channel.muscle};
  }
  double W_per_N() const {
    return channel.muscle.heat_transfer_W_per_K / channel.muscle.force_per_kelvin_N_per_K;
  }
};

TEST(HangingArm, HeatBalancesTheMusclesStretchAndTheExtraPullOfTheWeight) {
  for (const double angle_deg : {0.0, 10.0, 30.0, 45.0}) {
    const double position_m = angle_deg * rad_per_deg * lever_m;
    const double weight_N = weight_Nm * std::sin((angle_deg + 45.0) * rad_per_deg) / lever_m;
    DOUBLES_EQUAL(weight_N, arm().pull_N(position_m), 1e-12);
    const double heat_N =
        own_N_per_m * position_m + weight_N - weight_Nm * std::sin(-hangs_at_rad) / lever_m;
    DOUBLES_EQUAL(W_per_N() * heat_N, arm().power_W(position_m), 1e-7);
    DOUBLES_EQUAL(
        own_N_per_m + weight_Nm * std::cos((angle_deg + 45.0) * rad_per_deg) / (lever_m * lever_m),
        arm().stiffness_N_per_m(position_m), 1e-5);
  }
}

TEST(HangingArm, TipsOverWhereTheWeightEasesFasterThanTheMuscle) {
  const double max_m = 90.0 * rad_per_deg * lever_m;
  DOUBLES_EQUAL(max_m, arm().tips_over_m(max_m), 0.0);
  own_N_per_m = 8.0;
  setup();
  const double upright_rad = std::acos(-own_N_per_m * lever_m * lever_m / weight_Nm);
  DOUBLES_EQUAL((upright_rad + hangs_at_rad) * lever_m, arm().tips_over_m(max_m), 1e-3 * max_m);
  // However much power is available.
  DOUBLES_EQUAL(arm().tips_over_m(max_m), arm().held_m(1e3, max_m), 0.0);
}

TEST(HangingArm, IsHeldAsFarAsThePowerAllows) {
  const double max_m = channel.supervision.max_travel_m;
  const double held_m = arm().held_m(0.5 * arm().power_W(max_m), max_m);
  DOUBLES_EQUAL(0.5 * arm().power_W(max_m), arm().power_W(held_m), 2e-3 * arm().power_W(max_m));
  DOUBLES_EQUAL(0.0, arm().held_m(-1.0, max_m), 0.0);
  channel.limiter.max_W = 0.5 * arm().power_W(max_m);
  const Feasibility f = feasibility(channel, board);
  DOUBLES_EQUAL(arm().held_m(f.held_W, max_m), f.travel_m, 0.0);
  CHECK_COMPARE(f.travel_m, <, 0.9 * max_m);
  DOUBLES_EQUAL(f.fall_s, f.rise_s, 0.02 * f.fall_s);  // to where its power just holds it
}

TEST(HangingArm, WithAVariableLeverTheWeightPullsAtTheLocalLever) {
  const std::array<double, 3> radii_m{0.012, 0.015, 0.012};
  channel.joint.lever = control::Lever(-1.0, 1.0, radii_m);
  const double position_m = channel.joint.lever.arc_m(0.5);
  DOUBLES_EQUAL(weight_Nm * std::sin(0.5 - hangs_at_rad) / 0.0135, arm().pull_N(position_m), 1e-12);
}
