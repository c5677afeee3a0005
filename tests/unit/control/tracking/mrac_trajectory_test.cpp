// The MRAC against the paper's equations integrated by scipy (tests/reference/mrac_ode.py).
#include <CppUTest/TestHarness.h>

#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/muscle.hpp"
#include "unit/control/support/reference.hpp"

using namespace supercoil::control;
using Follower = ModelFollower<double, Mrac<double>>;

namespace {

MracSettings settings_of(const nlohmann::json& run) {
  MracSettings settings = *mrac_preset(run.at("preset").get<std::string>());
  if (run.at("preset") == "printed") settings = settings.scaled(run.at("factor"));
  settings.freeze_when_limited = false;
  return settings;
}

struct Difference {
  double position_W = 0.0;
  double theta = 0.0;
};

/// The largest differences at the run's times.
Difference difference(const nlohmann::json& run, double step_s) {
  const double gain = PhysicalParameters{}.dc_gain_m_per_W();
  ControllerSettings settings;
  settings.model = *reference_model_named(run.at("model").get<std::string>());
  Follower follower(settings, Mrac<double>(settings_of(run), step_s), step_s);
  const std::vector<double> times = run.at("time_s");
  const std::vector<double> positions = run.at("position_W");
  std::size_t next = 0;
  Difference result;
  supercoil::test::run_closed_loop(
      follower, step_s, times.back(), {run.at("min_W"), run.at("max_W")},
      supercoil::test::paper_sine_m, [&](const supercoil::test::Tick& tick) {
        if (next == times.size() || std::abs(tick.time_s - times[next]) > 0.5 * step_s) return;
        const auto theta =
            supercoil::test::vector_from<Vector<double, 6>>(run.at("theta").at(next));
        result.position_W =
            std::fmax(result.position_W, std::abs(tick.position_m / gain - positions[next]));
        result.theta =
            std::fmax(result.theta, (follower.law().theta() - theta).cwiseAbs().maxCoeff());
        ++next;
      });
  LONGS_EQUAL(times.size(), next);
  return result;
}

void expect_first_order(const char* name, double limit_W, double limit_theta) {
  for (const auto& run : supercoil::test::reference("mrac", "runs")) {
    if (run.at("name") != name) continue;
    const Difference coarse = difference(run, 1e-3);
    const Difference fine = difference(run, 0.5e-3);
    CHECK(coarse.position_W < limit_W);
    CHECK(coarse.theta < limit_theta);
    DOUBLES_EQUAL(2.0, coarse.position_W / fine.position_W, 0.3);
    DOUBLES_EQUAL(2.0, coarse.theta / fine.theta, 0.3);
    return;
  }
  FAIL("no such run among the reference values");
}

}  // namespace

TEST_GROUP(MracTrajectory){};

TEST(MracTrajectory, PrintedLawsConvergeToThePapersEquations) {
  expect_first_order("printed x 10", 5e-3, 2e-2);
}

TEST(MracTrajectory, PrintedLawsWithEq8AndLimitsConvergeToThePapersEquations) {
  expect_first_order("printed x 10, eq8, clipped", 5e-3, 2e-2);
}

TEST(MracTrajectory, DesignAConvergesToThePapersEquations) {
  expect_first_order("a", 5e-3, 2e-2);
}

TEST(MracTrajectory, DesignAWithLimitsConvergesToThePapersEquations) {
  expect_first_order("a, clipped", 5e-3, 2e-2);
}
