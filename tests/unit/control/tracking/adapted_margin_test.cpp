// Direct adaptive laws after they have adapted, sampled and delayed.
#include <array>
#include <deque>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/loop_margin.hpp"
#include "supercoil/control/tracking/mrac_matching.hpp"

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;

namespace {

constexpr double adapted_tick_s = 1e-3;
constexpr double adapted_delay_s = 1.5e-3;

/// Span of all physical parameters at once within which the law is stable at all corners.
struct Family {
  std::string name;
  double adapted;  ///< with the law adapted to each corner
  double resting;  ///< with the law adapted to the paper's muscle
};
const std::array<Family, 3> families{
    {{"printed", 0.40, 0.0}, {"a", 0.50, 0.35}, {"c", 0.15, 0.05}}};

ControllerSettings preset(const std::string& name) {
  ControllerSettings settings;
  settings.kind = name == "c" ? ControllerKind::mrac_ls : ControllerKind::mrac;
  if (name != "c") settings.mrac = *mrac_preset(name);
  return settings;
}

std::string corner_text(const WorstCorner& worst) {
  std::string text;
  for (const PhysicalRange& range : physical_ranges) {
    const bool more = worst.muscle.*range.member > PhysicalParameters{}.*range.member;
    text += std::string(more ? " +" : " -") + range.name;
  }
  return text + StringFromFormat("; spectral radius %.5f, modulus %.3f, %d of 64 unstable",
                                 worst.margin.spectral_radius, worst.margin.modulus, worst.unstable)
                    .asCharString();
}

std::string at_span(const std::string& what, double span) {
  return what + " at +-" + std::to_string(std::lround(100.0 * span)) + " %, worst corner:";
}

/// Runs the law with the θ* of the paper's muscle and without adaptation on a muscle after one
/// push.
bool grows_after_a_push(const std::string& name, const PhysicalParameters& parameters, int ticks) {
  ControllerSettings settings = preset(name);
  TransferFunction plant = transfer_function_from(PhysicalParameters{});
  plant.b3 = plant.b0;
  settings.mrac.initial = match(plant, settings.mrac, settings.model)->theta;
  settings.mrac.gain.setZero();
  settings.mrac.sigma_gain = 0.0;
  Controller controller(settings, adapted_tick_s);
  supercoil::test::Muscle muscle(parameters, adapted_tick_s);
  std::deque<double> powers_W(static_cast<std::size_t>(ticks), 0.0);
  double applied_W = 0.0;
  double early_m = 0.0;
  double late_m = 0.0;
  constexpr int all = 60'000;
  for (int k = 0; k < all; ++k) {
    const double position_m = muscle.position_m();
    const auto out = controller.step({.position_m = position_m, .applied_power_W = applied_W});
    powers_W.push_back(out.demanded_power_W + (k == 0 ? 1.0 : 0.0));
    applied_W = powers_W.front();
    powers_W.pop_front();
    muscle.step(applied_W);
    if (k < all / 4) early_m = std::fmax(early_m, std::abs(position_m));
    if (k >= 3 * all / 4) late_m = std::fmax(late_m, std::abs(position_m));
  }
  return !(late_m < early_m);
}

}  // namespace

TEST_GROUP(AdaptedMargins){};

TEST(AdaptedMargins, EachPresetIsStableOnEachMuscleOfItsFamilyOnceAdapted) {
  for (const Family& family : families) {
    const WorstCorner worst = worst_corner_adapted(preset(family.name), PhysicalParameters{},
                                                   family.adapted, adapted_tick_s, adapted_delay_s);
    UT_PRINT((at_span(family.name + " adapted", family.adapted) + corner_text(worst)).c_str());
    LONGS_EQUAL(0, worst.unstable);
  }
}

TEST(AdaptedMargins, EachPresetIsStableOnItsFamilyBeforeItReadapts) {
  for (const Family& family : families) {
    const auto law = fixed_law(preset(family.name), PhysicalParameters{});
    const WorstCorner worst =
        worst_corner(*law, PhysicalParameters{}, family.resting, adapted_tick_s, adapted_delay_s);
    UT_PRINT((at_span(family.name + " resting", family.resting) + corner_text(worst)).c_str());
    LONGS_EQUAL(0, worst.unstable);
  }
}

/// This is why the paper's own constants are not the default.
TEST(AdaptedMargins, ThePrintedLawHasNoMarginOnceAdapted) {
  const auto law = fixed_law(preset("printed"), PhysicalParameters{});
  CHECK(loop_margin(*law, PhysicalParameters{}, adapted_tick_s, adapted_delay_s).modulus < 0.01);
  CHECK(tolerated_span(*law, PhysicalParameters{}, adapted_tick_s, adapted_delay_s) < 0.01);
}

/// Before it has learned anything, the least-squares law is its PID.
TEST(AdaptedMargins, TheLeastSquaresLawIsStableOnItsFamilyAsAPid) {
  auto law = fixed_law(preset("c"), PhysicalParameters{});
  law->filtered.reset();
  const WorstCorner worst =
      worst_corner(*law, PhysicalParameters{}, 0.2, adapted_tick_s, adapted_delay_s);
  UT_PRINT(("c at its start, worst corner of +-20 %:" + corner_text(worst)).c_str());
  LONGS_EQUAL(0, worst.unstable);
}

/// The loop gain is below 1 at all frequencies.
TEST(AdaptedMargins, PresetAIsStableForAnyPowerDelay) {
  const auto law = fixed_law(preset("a"), PhysicalParameters{});
  for (const int ticks : {10, 300, 1000}) {
    const double delay_s = ticks * adapted_tick_s;
    CHECK_TRUE(loop_margin(*law, PhysicalParameters{}, adapted_tick_s, delay_s).stable());
    CHECK_FALSE(grows_after_a_push("a", PhysicalParameters{}, ticks));
  }
}

/// A stronger muscle raises the loop gain, a weaker one lowers it. At the edge a pole is on the
/// unit circle and the frequency response passes through −1.
TEST(AdaptedMargins, EachPresetIsStableUpToItsDocumentedForce) {
  const auto with_force = [](double times) {
    PhysicalParameters muscle;
    muscle.force_per_kelvin_N_per_K *= times;
    return muscle;
  };
  int edges = 0;
  for (const std::string name : {"printed", "a", "c"}) {
    const auto law = fixed_law(preset(name), PhysicalParameters{});
    for (const double step : {1.01, 1.0 / 1.01}) {
      const auto margin_at = [&](double times) {
        return loop_margin(*law, with_force(times), adapted_tick_s, 0.0);
      };
      double times = 1.0;
      while (margin_at(times).stable() && times > 0.1 && times < 10.0)
        times *= step;
      if (margin_at(times).stable()) continue;
      ++edges;
      UT_PRINT(StringFromFormat("%s is unstable at %.2f times the force, modulus %.3f",
                                name.c_str(), times, margin_at(times).modulus)
                   .asCharString());
      CHECK(margin_at(times).modulus < 0.02);
      if (name == "c") continue;  // its adaptation cannot be turned off
      CHECK_FALSE(grows_after_a_push(name, with_force(times / step / step), 0));
      CHECK_TRUE(grows_after_a_push(name, with_force(times * step), 0));
    }
  }
  CHECK(edges >= 4);
}
