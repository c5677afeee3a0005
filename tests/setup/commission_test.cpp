// Setup in lockstep, from descriptions up to 50 % off, of muscles that nothing was tuned on.
#include <algorithm>
#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "apps/supercoil/setup/steps.hpp"
#include "loop/promise.hpp"
#include "setup/commissioned.hpp"
#include "setup/listener.hpp"
#include "text/number_text.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr double error = 0.5;

Commissioned commissioned(unsigned seed) {
  return commission(held_out_muscle(seed, error));
}

}  // namespace

TEST_GROUP(Commission){};

/// A quick one, a slow one, and three that are not linear, one of which shows little of θ2.
TEST(Commission, TracksAsPromisedFromAHalfWrongDescription) {
  for (const unsigned seed : {30U, 37U, 66U, 45U, 73U}) {
    const HeldOut muscle = held_out_muscle(seed, error);
    const Commissioned c = commission(muscle);
    STRCMP_EQUAL("", c.refused.c_str());
    CHECK(c.fault == Fault::none);
    CHECK(c.error_m <= c.promised_m);
    CHECK(c.error_m > c.promised_m / 3.0);
    CHECK(c.travel_m > 1e-3);
    CHECK(c.hottest_rise_K < 105.0);  // 130 °C, where derating begins
    CHECK(c.took_s <= std::max(800.0, 15.0 * muscle.time_constant_s));
  }
}

/// A linear model explains too little of their full strokes.
TEST(Commission, ANonlinearMuscleTracksAsPromisedAfterShorterStrokes) {
  for (const unsigned seed : {1035U, 1097U, 1191U}) {
    const Commissioned c = commission(held_out_muscle(seed, error));
    STRCMP_EQUAL("", c.refused.c_str());
    CHECK(c.fault == Fault::none);
    CHECK(c.error_m <= c.promised_m);
    CHECK(c.unexplained_m > 0.0);
  }
}

/// Full strokes leave its theta3 uncertain, however often they are repeated.
TEST(Commission, AnUncertainMuscleTracksAsPromisedAfterShorterStrokes) {
  const Commissioned c = commissioned(1043);
  STRCMP_EQUAL("", c.refused.c_str());
  CHECK(c.error_m <= c.promised_m);
}

/// The strokes that found it agree within a few percent; the full ones say otherwise.
TEST(Commission, ShorterStrokesKeepTheUncertaintyOfTheFullOnes) {
  HeldOutBoard board(held_out_muscle(1097, error), "learned_ff", 0.02);
  Nobody nobody;
  operating::Commission steps = board.steps(nobody);
  CHECK_TRUE(steps.calibrate().has_value());
  const auto found = steps.identify();
  CHECK_TRUE(found.has_value());
  CHECK_COMPARE((*found)["theta3_deviation_ratio"].get<double>(), >, 0.1);
}

/// Short strokes of such a muscle show a time constant that is too short.
TEST(Commission, TimeConstantIsLearnedFromFullStrokesOnly) {
  const auto learned_s = [](const std::string& event) {
    HeldOut muscle = held_out_muscle(1097, error);
    muscle.scenario += event;
    HeldOutBoard board(muscle, "learned_ff", 0.02);
    Nobody nobody;
    operating::Commission steps = board.steps(nobody);
    CHECK_TRUE(steps.calibrate().has_value());
    static_cast<void>(steps.identify());
    return board.simulation().learned().value().heat.time_constant_s;
  };
  const double undisturbed_s = learned_s("");
  CHECK(undisturbed_s > 0.0);
  DOUBLES_EQUAL(undisturbed_s,
                learned_s("[[event]]\nat_s = 90.0\nplant.heat_transfer_W_per_K = 0.2\n"), 0.0);
}

TEST(Commission, DescriptionOfTheFirstMotionMatchesThePlan) {
  Feasibility feasibility{};
  feasibility.travel_m = 1.0;
  const FirstMotion motion = plan_first_motion(feasibility, 0.0);
  const std::string said = "between " + number_text(motion.middle_m - motion.amplitude_m, 3) +
                           " and " + number_text(motion.middle_m + motion.amplitude_m, 3) +
                           " of the travel that it can hold";
  STRCMP_CONTAINS(said.c_str(), std::string(operating::setup_steps.back().does).c_str());
}

/// A fiftieth of the supply's power moves it by millimetres.
TEST(Commission, TracksAsPromisedWithACoarsePwm) {
  HeldOut muscle = held_out_muscle(36, 0.1);
  const Commissioned fine = commission(muscle);
  muscle.board = {{"pwm.steps", "50", ""}, {"heater.error_feedback", "false", ""}};
  const Commissioned coarse = commission(muscle);
  CHECK(coarse.error_m > fine.promised_m);
  CHECK(coarse.error_m <= coarse.promised_m);
  muscle.board.pop_back();
  const Commissioned fed_back = commission(muscle);
  CHECK(fed_back.error_m <= fed_back.promised_m);
  DOUBLES_EQUAL(fine.promised_m, fed_back.promised_m, 0.1e-6);
}

TEST(Commission, NothingIsPromisedForAnUntestedControlLaw) {
  const Commissioned c = commission(held_out_muscle(24, error), "adaptive_ff");
  STRCMP_EQUAL("", c.refused.c_str());
  CHECK(std::isnan(c.promised_m));
  CHECK(c.error_m > 0.0);
}

TEST(Commission, AMuscleThatFitsNoModelIsRefusedWithTheReason) {
  const Commissioned c = commissioned(69);
  STRCMP_CONTAINS("identify ended: poor_fit", c.refused.c_str());
  STRCMP_CONTAINS("; for what to do see troubleshooting in `supercoil docs`", c.refused.c_str());
  CHECK(c.fault == Fault::none);
}

TEST(Commission, AFaultDuringIdentifyIsReportedWithItsPage) {
  HeldOut muscle = held_out_muscle(24, error);
  muscle.scenario += "[[event]]\nat_s = 20.0\ninjected_fault.heater_open = true\n";
  const Commissioned c = commission(muscle);
  STRCMP_EQUAL(
      "identify ended: interrupted, fault heater_open; see faults/heater_open in `supercoil docs`; "
      "when its cause is gone: supercoil command 1 reset",
      c.refused.c_str());
}

/// A time constant of 56 s, and senses never compared with a meter: a motion of some 20 um.
TEST(Commission, ReportsAMotionTooSmallToShowTracking) {
  for (const bool small : {true, false}) {
    HeldOutBoard board(small ? held_out_muscle(2002, error, 5.0) : held_out_muscle(24, error),
                       "learned_ff", small ? 0.0 : 0.02);
    Listener nobody;
    operating::Commission steps = board.steps(nobody);
    CHECK_TRUE(steps.calibrate().has_value());
    STRCMP_CONTAINS(" mm from where the cold muscle rests", nobody.take().c_str());
    CHECK_TRUE(steps.identify().has_value());
    const auto moved = steps.move();
    CHECK_TRUE(moved.has_value());
    const double promised_m = moved->value("promised_m", NAN);
    LONGS_EQUAL(small, promised_m > moved->value("standing_still_m", NAN));
    LONGS_EQUAL(small, nobody.take().find("a muscle that did not move at all would be off by") !=
                           std::string::npos);
  }
}

/// Time constants of 29, 30, 40 and 58 s; the second one is not linear.
TEST(Commission, ASlowMuscleTracksWithinTenMinutesOrFifteenTimeConstants) {
  for (const unsigned seed : {2018U, 2031U, 2028U, 2038U}) {
    constexpr double slower = 5.0;
    const HeldOut muscle = held_out_muscle(seed, error, slower);
    const Commissioned c = commission(muscle);
    STRCMP_EQUAL("", c.refused.c_str());
    CHECK(c.fault == Fault::none);
    CHECK_COMPARE(c.error_m, <=, c.promised_m);
    CHECK_COMPARE(c.took_s, <=, std::max(600.0, 15.0 * muscle.time_constant_s));
  }
}
