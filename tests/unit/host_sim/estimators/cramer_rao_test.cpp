#include "estimators/cramer_rao.hpp"

#include <CppUTest/TestHarness.h>

#include "estimators/bounds.hpp"
#include "estimators/contender.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using namespace supercoil::host_sim::estimators;

namespace {

Experiment experiment_from(double begin_s) {
  Bench bench(trials[0], 1);
  for (long left = std::lround(begin_s / tick_s); left > 0; --left)
    bench.next();
  return {.begin = bench.state(), .begin_s = begin_s, .power_W = [](double t) {
            return paper_excitation().at(t);
          }};
}

void check_percent(const control::Theta& expected, const control::Theta& bound, double part) {
  for (int i = 0; i < 4; ++i)
    DOUBLES_EQUAL(expected[i], 100.0 * bound[i], part * expected[i]);
}

}  // namespace

TEST_GROUP(CramerRao){};

// These figures are from an independent computation with scipy.
TEST(CramerRao, TwoSecondsFromRestAgreeWithScipy) {
  CramerRaoBound bound(experiment_from(0.0), {.motion = false, .bias = false});
  check_percent({0.53, 0.10, 0.03, 0.06}, bound.until(2.0), 0.06);
}

TEST(CramerRao, ASteadyWindowAgreesWithScipy) {
  CramerRaoBound bound(experiment_from(40.0), {.motion = true, .bias = false});
  const control::Theta ten = bound.until(50.0);
  CHECK(ten[0] > 0.027 && ten[0] < 0.068);
  check_percent({0.865, 0.022, 0.003, 0.0004}, bound.until(70.0), 0.1);
}

TEST(CramerRao, AnAdditionalUnknownRaisesTheBound) {
  const Experiment experiment = experiment_from(40.0);
  const auto deviation = [&](bool motion, bool bias) {
    return CramerRaoBound(experiment, {motion, bias}).until(50.0)[3];
  };
  CHECK(deviation(true, false) > deviation(false, false));
  CHECK(deviation(true, true) > deviation(true, false));
}

TEST(CramerRao, HalfTheNoiseIsHalfTheBound) {
  Experiment experiment = experiment_from(40.0);
  const control::Theta whole = CramerRaoBound(experiment, {}).until(50.0);
  experiment.noise_density_m2_s /= 4.0;
  const control::Theta half = CramerRaoBound(experiment, {}).until(50.0);
  for (int i = 0; i < 4; ++i)
    DOUBLES_EQUAL(0.5 * whole[i], half[i], 1e-6 * whole[i]);
}

TEST(CramerRao, WithoutDataTheBoundIsInfinite) {
  CramerRaoBound bound(experiment_from(0.0), {});
  CHECK(std::isinf(bound.until(0.01)[0]));
}
