// Fixed laws on muscles other than the nominal one, sampled and delayed.
#include "supercoil/control/tracking/loop_margin.hpp"

#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/control/support/noisy_loop.hpp"

using namespace supercoil::control;

namespace {

constexpr double tick_of_loop_s = 1e-3;
/// One and a half ticks from the sampling of a position to the power that responds to it.
constexpr double delay_of_loop_s = 1.5e-3;

FixedLaw law_of(ControllerKind kind) {
  ControllerSettings settings;
  settings.kind = kind;
  return fixed_law(settings, PhysicalParameters{}).value();
}

WorstCorner worst_of(ControllerKind kind, double span) {
  const WorstCorner worst =
      worst_corner(law_of(kind), PhysicalParameters{}, span, tick_of_loop_s, delay_of_loop_s);
  std::string text = std::string(name_of(controller_names, kind)) + " at +-" +
                     std::to_string(std::lround(100.0 * span)) + " %, worst corner:";
  for (const PhysicalRange& range : physical_ranges) {
    const bool more = worst.muscle.*range.member > PhysicalParameters{}.*range.member;
    text += std::string(more ? " +" : " -") + range.name;
  }
  text += "; spectral radius " + std::to_string(worst.margin.spectral_radius) + ", modulus " +
          std::to_string(worst.margin.modulus) + ", " + std::to_string(worst.unstable) +
          " of 64 unstable";
  UT_PRINT(text.c_str());
  return worst;
}

}  // namespace

TEST_GROUP(LoopMargins){};

TEST(LoopMargins, AdaptiveFeedforwardIsStableAtAllCornersOfPlusMinus20Percent) {
  const WorstCorner worst = worst_of(ControllerKind::adaptive_ff, 0.2);
  LONGS_EQUAL(0, worst.unstable);
  CHECK(worst.margin.modulus > 0.05);
}

TEST(LoopMargins, AdaptiveFeedforwardIsUnstableAtPlusMinus50Percent) {
  CHECK(worst_of(ControllerKind::adaptive_ff, 0.5).unstable > 0);
}

TEST(LoopMargins, TheNominalMuscleHasAmpleMargin) {
  const auto margin = loop_margin(law_of(ControllerKind::adaptive_ff), PhysicalParameters{},
                                  tick_of_loop_s, delay_of_loop_s);
  CHECK_TRUE(margin.stable());
  CHECK(margin.modulus > 0.4);
}

TEST(LoopMargins, SpanIsWhereTheFirstCornerFails) {
  const FixedLaw law = law_of(ControllerKind::adaptive_ff);
  const double span = tolerated_span(law, PhysicalParameters{}, tick_of_loop_s, delay_of_loop_s);
  UT_PRINT(StringFromFormat("adaptive_ff holds for +-%.0f %%", 100.0 * span).asCharString());
  LONGS_EQUAL(
      0, worst_corner(law, PhysicalParameters{}, span, tick_of_loop_s, delay_of_loop_s).unstable);
  CHECK(worst_corner(law, PhysicalParameters{}, span + 0.01, tick_of_loop_s, delay_of_loop_s)
            .unstable > 0);
}

TEST(LoopMargins, PaperFixedLawsAtThePresetsOfTheirFamily) {
  for (const auto kind : {ControllerKind::pi, ControllerKind::pd_ff}) {
    const WorstCorner worst = worst_of(kind, 0.0);
    LONGS_EQUAL(0, worst.unstable);
  }
}

/// Checks both sides of the computed edge: a little less delay is stable, a little more is not.
TEST(LoopMargins, StabilityOfASimulatedLoopAgreesWithItsMargin) {
  const FixedLaw law = law_of(ControllerKind::adaptive_ff);
  const auto grows = [&](int ticks) {
    supercoil::test::Muscle muscle(PhysicalParameters{}, tick_of_loop_s);
    const double pole = law.derivative_filter_rad_per_s;
    StateVariableFilter<double, 2, Hold::first_order> slope({pole * pole, 2.0 * pole, 1.0},
                                                            tick_of_loop_s);
    std::vector<double> powers_W(static_cast<std::size_t>(ticks) + 1, 0.0);
    double integral_W = 0.0;
    double early = 0.0;
    double late = 0.0;
    for (int k = 0; k < 20'000; ++k) {
      const double position_m = muscle.position_m();
      slope.step(position_m);
      integral_W -= position_m * law.integral_W_per_m_s * tick_of_loop_s;
      powers_W.push_back(integral_W - position_m * law.proportional_W_per_m -
                         slope.state()[1] * pole * pole * law.derivative_Ws_per_m +
                         (k == 0 ? 1.0 : 0.0));
      muscle.step(powers_W[powers_W.size() - 1 - static_cast<std::size_t>(ticks)]);
      if (k < 5'000) early = std::fmax(early, std::abs(muscle.position_m()));
      if (k >= 15'000) late = std::fmax(late, std::abs(muscle.position_m()));
    }
    return late > early;
  };
  int ticks = 0;
  while (loop_margin(law, PhysicalParameters{}, tick_of_loop_s, ticks * tick_of_loop_s).stable())
    ++ticks;
  UT_PRINT(StringFromFormat("unstable from %d ticks of delay on", ticks).asCharString());
  CHECK(ticks > 10);
  const auto modulus = [&](int delay_ticks) {
    return loop_margin(law, PhysicalParameters{}, tick_of_loop_s, delay_ticks * tick_of_loop_s)
        .modulus;
  };
  CHECK_COMPARE(modulus(ticks - 1), >, 0.0);
  DOUBLES_EQUAL(0.0, modulus(ticks), 0.0);
  CHECK_FALSE(grows(ticks - 1));
  CHECK_TRUE(grows(ticks));
}
