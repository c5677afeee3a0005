// The table that the program must print, row by row (docs/paper.md).
#include "paper/reproduction.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include <CppUTest/TestHarness.h>

using namespace supercoil::host_sim::paper;

namespace {

/// "id case" → measured value, for all parts; computed once for all tests.
const std::map<std::string, std::string>& table() {
  static const auto rows = [] {
    std::map<std::string, std::string> result;
    for (const Part& part : reproduce([](double) {})) {
      for (const ReproductionRow& row : part.rows) {
        std::string& value = result[row.id + " " + row.case_name];
        CHECK_TEXT(value.empty(), (row.id + " " + row.case_name + " stands twice").c_str());
        value = row.measured;
      }
    }
    return result;
  }();
  return rows;
}

std::string measured(const std::string& row) {
  const auto found = table().find(row);
  CHECK_TEXT(found != table().end(), (row + " is missing").c_str());
  return found->second;
}

double number(const std::string& row) {
  return std::strtod(measured(row).c_str(), nullptr);
}

void check_near(double expected, const std::string& row, double tolerance) {
  const double value = number(row);
  const std::string text = row + " is " + std::to_string(value);
  CHECK_TEXT(std::abs(value - expected) <= tolerance, text.c_str());
}

void check_within(double expected, const std::string& row, double relative) {
  check_near(expected, row, std::abs(expected) * relative);
}

}  // namespace

TEST_GROUP(Reproduction){};

TEST(Reproduction, GradientEstimatorConvergesAsPrinted) {
  const double error_percent[] = {-6.0, -0.7, 3.1, 1.7};
  const double exit_s[] = {71.4, 88.9, 49.8, 45.3};
  for (int i = 0; i < 4; ++i) {
    const std::string id = "fig2.theta" + std::to_string(i + 1);
    check_near(error_percent[i], id + ".error_at_69s printed", 0.3);
    check_near(exit_s[i], id + ".last_exit_5pct printed", 1.0);
  }
}

TEST(Reproduction, PiAndPdffAgreeWithin3Percent) {
  check_within(0.01905, "fig3.sine.pi unsaturated", 0.03);
  check_within(0.01067, "fig3.sine.pdff unsaturated", 0.03);
  check_within(0.0113, "fig4.sine.pdff unsaturated", 0.03);
  check_within(5.79e-4, "fig3.step.pdff unsaturated", 0.03);
  check_within(0.00808, "fig4.step.pdff unsaturated", 0.03);
  check_within(1.35e-3, "fig3.step.pi unsaturated", 0.03);
}

TEST(Reproduction, PiDivergesWhenTheMuscleSoftens) {
  STRCMP_EQUAL("diverges", measured("fig4.sine.pi unsaturated").c_str());
  STRCMP_EQUAL("diverges", measured("fig4.step.pi unsaturated").c_str());
}

TEST(Reproduction, MracAgreesWithin10PercentInEveryReading) {
  struct Reading {
    const char* name;
    double sine_before, sine_after, step_before, step_after;
  };
  const Reading readings[] = {
      {"eq8.saturated", 4.9e-2, 2.3e-2, 2.1e-3, 9.2e-4},
      {"design.saturated", 5.9e-2, 7.5e-2, 3.8e-5, 1.02e-3},
      {"wm16.saturated", 2.7e-2, 1.7e-2, 3.2e-5, 1.02e-3},
      {"wm16.saturated.c0", 3.0e-2, 1.6e-2, 1.5e-6, 3.6e-4},
      {"eq8.x200", 9.0e-3, 6.1e-3, 4.5e-5, 4.3e-7},
      {"wm16.x200", 1.9e-3, 3.4e-3, 1e-16, 4e-10},
  };
  for (const Reading& r : readings) {
    const std::string name = std::string(" ") + r.name;
    const auto check = [&](double expected, const std::string& id) {
      if (expected < 1e-6) {
        CHECK_COMPARE(number(id + name), <, 1e-6);
      } else {
        check_within(expected, id + name, 0.10);
      }
    };
    check(r.sine_before, "fig3.sine.mrac");
    check(r.sine_after, "fig4.sine.mrac");
    check(r.step_before, "fig3.step.mrac");
    check(r.step_after, "fig4.step.mrac");
  }
}

TEST(Reproduction, ErrataAreComputed) {
  check_near(0.58985, "errata.b3 Eq. (5)", 1e-5);
  check_near(0.00478, "errata.b3 as printed", 1e-5);
  check_near(68.587, "errata.numerator used in Sec. 5.2", 1e-3);
  check_near(0.084, "errata.eq8.damping Eq. (8)", 1e-3);
  check_near(77.0, "errata.eq8.overshoot second-order formula", 1.0);
  check_near(40.0, "errata.eq8.overshoot simulated step", 1.0);
  CHECK_COMPARE(number("errata.eq8.overshoot design"), <, 5.0);
  check_near(1.25, "errata.eq7.dc_gain Eq. (7)", 1e-9);
  STRCMP_EQUAL("no", measured("errata.wm.spr eq8").c_str());
  STRCMP_EQUAL("no", measured("errata.wm.spr design").c_str());
  STRCMP_EQUAL("yes", measured("errata.wm.spr wm16").c_str());
  check_near(73.251, "errata.perturbation.b0 ϱ = 12", 1e-3);
  check_near(145.542, "errata.perturbation.b1 ϱ = 12", 1e-3);
  check_near(0.267, "errata.power.range least", 1e-3);
  check_near(4.733, "errata.power.range greatest", 1e-3);
  check_near(5.2, "errata.power.range above 4.5 W", 0.1);
  check_near(-0.14, "errata.reference.negative_power eq8", 0.01);
  check_near(6.04, "errata.scale.dc_gain true units", 0.01);
  check_near(0.158, "errata.pi.perturbed_roots continuous loop", 0.005);
}

TEST(Reproduction, Equation17HoldsUntilThePowerIsClipped) {
  // The error that remains without clipping comes from the discretisation: 1 ms steps.
  CHECK_COMPARE(number("errata.eq17 not clipped"), <, 0.002);
  CHECK_COMPARE(number("errata.eq16 clipped"), >, 3.0 * number("errata.eq17 not clipped"));
}

TEST(Reproduction, PhysicalMuscleIsTrackedAsInTheTrial) {
  check_within(225.0, "physical.sine.pi before", 0.03);
  check_within(222.0, "physical.sine.pdff before", 0.03);
  check_within(168.0, "physical.sine.pi after", 0.03);
  check_within(329.0, "physical.sine.pdff after", 0.03);
  check_within(43.0, "physical.sine.mrac_printed_x10 before", 0.10);
  check_within(97.0, "physical.sine.mrac_printed_x10 after", 0.10);
  CHECK_COMPARE(number("physical.sine.mrac_a before"), <, 15.0);
  CHECK_COMPARE(number("physical.sine.mrac_a after"), <, 12.0);
}

TEST(Reproduction, FixedPointStaysWithinAMicrometreOfDouble) {
  CHECK_COMPARE(number("arithmetic.q8_24.mrac preset a"), <, 1.0);
  CHECK_COMPARE(number("arithmetic.q8_24.gradient printed"), <, 1.0);
  CHECK_COMPARE(number("arithmetic.q8_24.mrac preset a"), >, 0.0);
}
