// The design of an MRAC: matching, presets.
#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/controller.hpp"
#include "supercoil/control/tracking/mrac_matching.hpp"

#include "unit/control/support/muscle.hpp"
#include "unit/control/support/reference.hpp"

using namespace supercoil::control;
using Parameters = MracSettings::Parameters;

namespace {

/// The muscle with position in watts at rest.
TransferFunction normalised(const PhysicalParameters& p) {
  TransferFunction plant = transfer_function_from(p);
  plant.b3 = plant.b0;
  return plant;
}

/// Matched parameters, adaptation off: the largest difference from the reference model, in metres.
double matched_difference(double step_s) {
  ControllerSettings settings;
  settings.mrac = *mrac_preset("a");
  const auto matching = match(normalised(PhysicalParameters{}), settings.mrac, settings.model);
  CHECK(matching->compensator_stable);
  settings.mrac.initial = matching->theta;
  settings.mrac.gain.setZero();
  settings.mrac.sigma_gain = 0.0;
  Controller controller(settings, step_s);
  double worst = 0.0;
  supercoil::test::run_closed_loop(
      controller, step_s, 40.0, supercoil::test::no_limits, supercoil::test::paper_sine_m,
      [&](const supercoil::test::Tick& tick) {
        worst = std::fmax(worst, std::abs(tick.position_m - tick.model_m));
      });
  return worst;
}

/// How preset a moves a muscle that needs `scale` times the paper's power for the same motion.
std::vector<double> positions_m(double scale) {
  PhysicalParameters muscle;
  muscle.thermal_mass_J_per_K *= scale;
  muscle.heat_transfer_W_per_K *= scale;
  ControllerSettings settings;
  settings.set_nominal(muscle, scale * paper_max_W);
  settings.mrac = *mrac_preset("a", scale * paper_max_W);
  Controller controller(settings, 1e-3);
  std::vector<double> result;
  supercoil::test::run_closed_loop(
      controller, 1e-3, 40.0, PowerRange{0.0, scale * paper_max_W}, supercoil::test::paper_sine_m,
      [&](const supercoil::test::Tick& tick) { result.push_back(tick.position_m); }, muscle);
  return result;
}

}  // namespace

TEST_GROUP(MracDesign){};

TEST(MracDesign, PresetAAdaptsEquallyFastWhateverThePowerOfTheMuscle) {
  const auto papers = positions_m(1.0);
  for (const double scale : {0.1, 3.0, 10.0}) {
    const auto scaled = positions_m(scale);
    CHECK_EQUAL(papers.size(), scaled.size());
    for (std::size_t i = 0; i < papers.size(); ++i)
      DOUBLES_EQUAL(papers[i], scaled[i], 1e-9);
  }
}

TEST(MracDesign, MatchingSolvesThePolynomialIdentityAsNumpyDoes) {
  for (const auto& c : supercoil::test::reference("mrac", "matching")) {
    MracSettings settings;
    settings.alpha = c.at("alpha").get<std::array<double, 2>>();
    settings.lambda = c.at("lambda").get<Polynomial<2>>();
    const auto model = *reference_model_named(c.at("model").get<std::string>());
    const auto plant = normalised(supercoil::test::parameters_from(c.at("parameters")));
    const auto result = match(plant, settings, model);
    CHECK(result.has_value());
    const auto expected = supercoil::test::vector_from<Parameters>(c.at("theta"));
    CHECK((result->theta - expected).norm() <= 1e-8 * expected.norm());
    const bool stable = c.at("compensator_stable");
    CHECK_EQUAL(stable, result->compensator_stable);
  }
}

TEST(MracDesign, ThePapersLambdaNeedsAnUnstableCompensator) {
  const auto plant = normalised(PhysicalParameters{});
  CHECK_FALSE(match(plant, MracSettings{}, wm16_model())->compensator_stable);
  CHECK(match(plant, *mrac_preset("a"), wm16_model())->compensator_stable);
}

TEST(MracDesign, MatchingIsRefusedWithoutAnInputToAParameter) {
  const auto plant = normalised(PhysicalParameters{});
  MracSettings settings;
  settings.alpha = {0.0, 1.0};
  CHECK_FALSE(match(plant, settings, wm16_model()).has_value());
  settings.alpha = {1.0, 0.0};
  CHECK_FALSE(match(plant, settings, wm16_model()).has_value());
  TransferFunction negative = plant;
  negative.b3 = -1.0;
  CHECK_FALSE(match(negative, MracSettings{}, wm16_model()).has_value());
}

TEST(MracDesign, WithMatchedParametersTheLoopIsTheReferenceModel) {
  const double coarse = matched_difference(1e-3);
  const double fine = matched_difference(0.5e-3);
  CHECK(coarse < 20e-6);  // of 20 mm; the hold alone delays the power by half a step
  DOUBLES_EQUAL(2.0, coarse / fine, 0.1);
}

TEST(MracDesign, PresetPrintedIsThePapersDesign) {
  const MracSettings s = *mrac_preset("printed");
  CHECK((s.gain == Parameters{6, 6, 6, 7, 2, 3}));
  CHECK((s.alpha == std::array<double, 2>{1.0, 1.0}));
  CHECK((s.lambda == Polynomial<2>{2.0, 3.0, 1.0}));
  CHECK(s.p0_rad_per_s == 4.0 && s.p1_rad_per_s == 5.0 && s.q0_rad_per_s == 0.8);
  CHECK(s.sigma_gain == 4.0 && s.damping == 3.0);
  CHECK(s.initial.isZero());
}

TEST(MracDesign, PresetAIsDesignA) {
  const MracSettings s = *mrac_preset("a");
  CHECK((s.gain == Parameters{120, 120, 120, 140, 40, 60}));
  CHECK((s.alpha == std::array<double, 2>{20.0, 400.0}));
  CHECK((s.lambda == Polynomial<2>{400.0, 40.0, 1.0}));
  CHECK(s.sigma_gain == 80.0 && s.damping == 1.0);
  CHECK((s.initial == Parameters{0, 0, 0, 0, 0, 0.3}));
  CHECK(s.freeze_when_limited);
}

TEST(MracDesign, ScalingAffectsOnlyThePiAndNu) {
  const MracSettings s = MracSettings{}.scaled(10.0);
  CHECK((s.scaled_gain() == Parameters{60, 60, 60, 70, 20, 30}));
  CHECK(s.scaled_sigma_gain() == 40.0 && s.damping == 3.0);
  CHECK(s.gain == MracSettings{}.gain && s.sigma_gain == 4.0);
  CHECK_FALSE(mrac_preset("b").has_value());
}
