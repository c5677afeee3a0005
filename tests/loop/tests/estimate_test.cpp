// Published estimates: the estimator's values, and NaN for those that it does not have.
#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

Scenario of_estimators(const std::string& text) {
  const auto scenario = parse_scenario(
      "simulation.duration_s = 16.0\n[reference]\nkind = 'steps'\nlevels_m = [0.012, 0.008]\n"
      "hold_s = 2.0\n" +
          text,
      "estimate.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  return *scenario;
}

bool deviates(const Snapshot& s) {
  const bool any = !(std::isnan(s.bias_W) && s.deviation.array().isNaN().all() &&
                     std::isnan(s.bias_deviation_W));
  const bool all =
      std::isfinite(s.bias_W) && s.deviation.allFinite() && std::isfinite(s.bias_deviation_W);
  CHECK(any == all);
  return all;
}

}  // namespace

TEST_GROUP(PublishedEstimate){};

TEST(PublishedEstimate, LeastSquaresHasBiasAndDeviationsAndNoneHasNothing) {
  const Scenario scenario = of_estimators(
      "[estimator]\nkind = 'least_squares'\ntrusted_error = 100.0\n[[event]]\nat_s = "
      "15.0\nestimator.kind = 'none'\n");
  Simulation simulation(scenario);
  bool trusted = false;
  while (!simulation.done()) {
    simulation.step();
    const Snapshot& s = simulation.loop().channel(0).snapshot();
    const auto estimate = simulation.estimate();
    if (!estimate) {
      CHECK_FALSE(s.trusted || deviates(s));
      CHECK(s.theta.array().isNaN().all() && std::isnan(s.error_bound));
      continue;
    }
    trusted = s.trusted;
    CHECK(s.trusted == estimate->trusted);
    CHECK(s.theta == estimate->theta);
    CHECK(deviates(s) == std::isfinite(estimate->bias_deviation_W));
    if (!deviates(s)) continue;
    CHECK(s.bias_W == estimate->bias_W);
    CHECK(s.deviation == estimate->deviation);
    CHECK(s.bias_deviation_W == estimate->bias_deviation_W);
  }
  CHECK(trusted);
  CHECK_FALSE(simulation.estimate().has_value());
}

TEST(PublishedEstimate, GradientLawHasNeitherBiasNorDeviations) {
  const Scenario scenario = of_estimators("[estimator]\nkind = 'gradient'\n");
  Simulation simulation(scenario);
  while (!simulation.done()) {
    simulation.step();
    CHECK_FALSE(deviates(simulation.loop().channel(0).snapshot()));
    CHECK(simulation.loop().channel(0).snapshot().theta == simulation.estimate()->theta);
  }
}
