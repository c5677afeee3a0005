// Counts what the control library allocates while it steps: it must not allocate at all.
#include <cstdio>
#include <memory>
#include <vector>

#include "supercoil/control/estimation/estimator.hpp"

#include "support/watched_calls.hpp"
#include "unit/control/support/muscle.hpp"

namespace {

using namespace supercoil::control;

constexpr int steps = 100'000;
constexpr double step_s = 1e-3;
int failures = 0;

using supercoil::test::counted;
using supercoil::test::keep;
using supercoil::test::WatchedCalls;

void expect_none(const char* what, std::string_view arithmetic, const WatchedCalls& seen) {
  std::printf("%-9s %-7.*s malloc %ld, new %ld in %d steps\n", what,
              static_cast<int>(arithmetic.size()), arithmetic.data(), seen.heap, seen.news, steps);
  if (seen.heap != 0 || seen.news != 0) ++failures;
}

void check_controllers() {
  for (const auto& [kind_name, kind] : controller_names) {
    for (const auto& [arithmetic_name, arithmetic] : arithmetic_names) {
      ControllerSettings settings;
      settings.kind = kind;
      settings.arithmetic = arithmetic;
      settings.mrac = MracSettings{}.scaled(10.0);
      // All options are on, so that every branch runs.
      settings.mrac.bounds = Box<double, 6>{MracSettings::Parameters::Constant(-50.0),
                                            MracSettings::Parameters::Constant(50.0)};
      settings.mrac.sigma_modification = 1e-4;
      settings.mrac.dead_zone_W = 1e-4;
      settings.shape_reference = true;
      Controller controller(settings, step_s);
      expect_none(kind_name.data(), arithmetic_name, counted([&] {
                    supercoil::test::run_closed_loop(controller, step_s, steps * step_s,
                                                     PowerRange{}, supercoil::test::paper_sine_m,
                                                     [](const supercoil::test::Tick&) {});
                  }));
    }
  }
}

void check_estimators() {
  for (const auto& [kind_name, kind] : estimator_names) {
    for (const auto& [arithmetic_name, arithmetic] : arithmetic_names) {
      EstimatorSettings settings;
      settings.kind = kind;
      settings.arithmetic = arithmetic;
      settings.gradient.normalisation = 0.5;
      settings.gradient.bounds =
          Box<double, 4>{Theta{0.1, 1.0, 10.0, 10.0}, Theta{60.0, 120.0, 1000.0, 500.0}};
      Estimator estimator(settings, step_s);
      supercoil::test::Muscle muscle(PhysicalParameters{}, step_s);
      expect_none(kind_name.data(), arithmetic_name, counted([&] {
                    for (int k = 0; k < steps; ++k) {
                      const double power_W = supercoil::test::paper_power_W(step_s * k);
                      muscle.step(power_W);
                      estimator.step(muscle.position_m(), power_W);
                      auto estimate = estimator.estimate();
                      keep(&estimate);
                    }
                  }));
    }
  }
}

}  // namespace

int main() {
  failures += supercoil::test::prove_the_counters();
  check_controllers();
  check_estimators();
  std::printf(failures == 0 ? "no allocation in any step\n" : "%d FAILED\n", failures);
  return failures == 0 ? 0 : 1;
}
