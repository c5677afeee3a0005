#include "estimators/bounds.hpp"

#include <cmath>
#include <cstdint>

#include "estimators/contender.hpp"
#include "estimators/cramer_rao.hpp"
#include "estimators/outcome.hpp"

namespace supercoil::host_sim::estimators {

using control::Theta;

namespace {

Experiment experiment_of(const Trial& trial, double begin_s) {
  Bench bench(trial, 0);
  for (std::int64_t left = std::llround(begin_s / tick_s); left > 0; --left)
    bench.next();
  return {.begin = bench.state(),
          .begin_s = begin_s,
          .power_W = [excitation = paper_excitation()](double t) { return excitation.at(t); },
          .noise_density_m2_s = trial.noise_density_m2_s()};
}

/// When the bound first fits into the band, from the beginning of the experiment.
Theta times_to(double band, const Experiment& experiment, const Unknown& unknown, double end_s) {
  constexpr double deviations = 2.0;
  constexpr double look_s = 0.05;
  CramerRaoBound bound(experiment, unknown);
  Theta times_s = Theta::Constant(INFINITY);
  for (double t = look_s; t < end_s && !times_s.allFinite(); t += look_s) {
    const Theta now = bound.until(experiment.begin_s + t);
    for (int i = 0; i < 4; ++i) {
      if (deviations * now[i] <= band && std::isinf(times_s[i])) times_s[i] = t;
    }
  }
  return times_s;
}

std::vector<Theta> plotted(const Experiment& experiment, const Unknown& unknown) {
  CramerRaoBound bound(experiment, unknown);
  std::vector<Theta> values;
  for (const double t : plotted_s())
    values.push_back(bound.until(experiment.begin_s + t));
  return values;
}

}  // namespace

Bounds bounds_of(const Trial& trial) {
  const Unknown at_rest{.motion = false, .bias = true};
  const Unknown moving{.motion = true, .bias = true};
  const Experiment rest = experiment_of(trial, 0.0);
  const Experiment changed = experiment_of(trial, trial.change_at_s);
  const Experiment steady = experiment_of(trial, trial.change_at_s - bound_window_s - tick_s);
  return {times_to(wide_band, rest, at_rest, trial.change_at_s),
          times_to(narrow_band, rest, at_rest, trial.change_at_s),
          times_to(wide_band, changed, moving, trial.duration_s - trial.change_at_s),
          CramerRaoBound(steady, moving).until(trial.change_at_s),
          plotted(rest, at_rest),
          plotted(changed, moving)};
}

}  // namespace supercoil::host_sim::estimators
