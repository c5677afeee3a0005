#include "supercoil/identification/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <iterator>
#include <limits>

namespace supercoil::identification {

namespace {

constexpr std::array addable{Effect::drift,        Effect::force,      Effect::heat_transfer,
                             Effect::heated_air,   Effect::hysteresis, Effect::creep,
                             Effect::lonely_stroke};
constexpr std::size_t max_effects = 4;
/// An effect must lower the error by this ratio, and by this much of the stroke.
constexpr double min_improvement_ratio = 0.1;
constexpr double min_stroke_ratio = 0.001;
/// It must also lower the error of the whole motion by this ratio. An error within
/// min_stroke_ratio needs no effect.
constexpr double min_overall_ratio = 0.03;

double explained_of(const Samples& samples, double rms_m, Span span) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!span.holds(samples.time_s(k)) || !samples.measured(k)) continue;
    sum += samples.position_m[k];
    squares += samples.position_m[k] * samples.position_m[k];
    count += 1.0;
  }
  const double mean = sum / count;
  return 1.0 - rms_m * rms_m / (squares / count - mean * mean);
}

double stroke_within(const Samples& samples, Span span) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!span.holds(samples.time_s(k)) || !samples.measured(k)) continue;
    lowest = std::min(lowest, samples.position_m[k]);
    highest = std::max(highest, samples.position_m[k]);
  }
  return highest - lowest;
}

/// A model's error on data to which it was not fitted.
double unseen_error(const EvaluatedModel& model) {
  return std::hypot(model.fit.cross_validated_m, model.unseen_rms_m);
}

/// Fits each of these models from the same start.
std::vector<EvaluatedModel> fit_each(const std::vector<Effects>& models, const Muscle& start,
                                     const Samples& samples, const Parts& parts) {
  std::vector<std::future<EvaluatedModel>> started;
  started.reserve(models.size());
  for (const Effects& effects : models) {
    started.push_back(std::async(std::launch::async, [&, effects] {
      return evaluate(refit(start, effects, samples, parts.fitted), samples, parts);
    }));
  }
  std::vector<EvaluatedModel> result;
  result.reserve(started.size());
  for (std::future<EvaluatedModel>& fit : started)
    result.push_back(fit.get());
  return result;
}

std::vector<EvaluatedModel>::iterator best_of(std::vector<EvaluatedModel>& models) {
  return std::min_element(models.begin(), models.end(),
                          [](const EvaluatedModel& a, const EvaluatedModel& b) {
                            return unseen_error(a) < unseen_error(b);
                          });
}

/// Whether a model is worth one more effect than another, on unseen data and over the whole motion.
/// The first alone would see a difference between two models that are both within the noise.
bool is_improvement(const EvaluatedModel& larger, const EvaluatedModel& smaller, double stroke_m) {
  const double error_m = unseen_error(smaller);
  const double min_m = min_stroke_ratio * stroke_m;
  const bool unseen =
      error_m - unseen_error(larger) > std::max(min_improvement_ratio * error_m, min_m);
  const bool all = overall_rms(smaller) > min_m &&
                   overall_rms(larger) < (1.0 - min_overall_ratio) * overall_rms(smaller);
  return unseen && all;
}

/// Appends models better than all before, in the first round all. Returns the index of the best.
std::size_t add_effects_to(std::vector<EvaluatedModel>& models, const Samples& samples,
                           const Parts& parts, double stroke_m) {
  std::size_t best = 0;
  for (std::size_t round = 0; round < max_effects; ++round) {
    std::vector<Effects> larger;
    const Effects base = models[best].fit.effects;
    for (const Effect effect : addable)
      if (!base.has(effect)) larger.push_back(base.with(effect));
    std::vector<EvaluatedModel> candidates =
        fit_each(larger, models[best].fit.muscle, samples, parts);
    const auto found = best_of(candidates);
    const bool improves = is_improvement(*found, models[best], stroke_m);
    const std::size_t before = models.size();
    if (round == 0) {
      if (improves) best = before + static_cast<std::size_t>(found - candidates.begin());
      std::move(candidates.begin(), candidates.end(), std::back_inserter(models));
    } else if (improves) {
      models.push_back(std::move(*found));
      best = before;
    }
    if (!improves) break;
  }
  return best;
}

/// An effect that was added early may have stood in for a later one.
std::size_t remove_effects_from(std::vector<EvaluatedModel>& models, std::size_t best,
                                const Samples& samples, const Parts& parts, double stroke_m) {
  while (true) {
    std::vector<Effects> smaller;
    const Effects base = models[best].fit.effects;
    for (const Effect effect : addable)
      if (base.has(effect)) smaller.push_back(base.without(effect));
    if (smaller.size() < 2) return best;
    std::vector<EvaluatedModel> candidates =
        fit_each(smaller, models[best].fit.muscle, samples, parts);
    const auto found = best_of(candidates);
    if (is_improvement(models[best], *found, stroke_m)) return best;
    models.push_back(std::move(*found));
    best = models.size() - 1;
  }
}

}  // namespace

EvaluatedModel evaluate(Fit fit, const Samples& samples, const Parts& parts) {
  EvaluatedModel result;
  result.fitted_rms_m = fit.rms_m;
  result.unseen_rms_m = rms_error(samples, fit.predicted_m, parts.unseen);
  result.fitted_explained = explained_of(samples, result.fitted_rms_m, parts.fitted);
  result.unseen_explained = explained_of(samples, result.unseen_rms_m, parts.unseen);
  result.fit = std::move(fit);
  return result;
}

double overall_rms(const EvaluatedModel& model) {
  return std::hypot(model.fitted_rms_m, model.unseen_rms_m) / std::sqrt(2.0);
}

Parts default_parts(const Samples& samples) {
  const double full_W = sizes_of(samples).full_W;
  const double end_s = samples.end_s();
  const double duration_s = end_s - samples.start_s;
  constexpr double at_rest = 0.02;
  constexpr double rest_s = 1.0;
  int heatings = 0;
  double last_s = samples.start_s;
  double resting_s = rest_s;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples.power_W[k] <= at_rest * full_W) {
      resting_s += samples.step_s;
      continue;
    }
    if (resting_s >= rest_s) {
      ++heatings;
      last_s = samples.time_s(k);
    }
    resting_s = 0.0;
  }
  const bool by_heating = heatings >= 2 && last_s - samples.start_s > 0.3 * duration_s &&
                          end_s - last_s > 0.1 * duration_s;
  const double at_s = by_heating ? last_s : samples.start_s + duration_s * 2.0 / 3.0;
  return {{samples.start_s, at_s - 0.5 * samples.step_s}, {at_s - 0.5 * samples.step_s, end_s}};
}

Comparison compare(const Samples& samples, const Parts& parts) {
  Comparison result;
  result.sizes = sizes_of(samples);
  result.parts = parts;
  result.unseen_stroke_ratio = stroke_within(samples, parts.unseen) / result.sizes.stroke_m;
  result.models.push_back(evaluate(fit_model({}, samples, parts.fitted), samples, parts));
  const double stroke_m = result.sizes.stroke_m;
  const std::size_t added = add_effects_to(result.models, samples, parts, stroke_m);
  result.chosen = remove_effects_from(result.models, added, samples, parts, stroke_m);
  result.transformation =
      evaluate(fit_model({Effect::transformation}, samples, parts.fitted), samples, parts);
  result.rejection_reason = why_rejected(result, samples);
  return result;
}

Effects linear_effects(const Effects& effects) {
  Effects result;
  for (const Effect effect : {Effect::drift, Effect::lonely_stroke})
    if (effects.has(effect)) result = result.with(effect);
  return result;
}

Change max_change(const Fit& first, const Fit& second) {
  Change result{0, 1.0, 0.0};
  for (std::size_t i = 0; i < first.parameters.size(); ++i) {
    const auto member = first.parameters[i].member;
    if (member != &Muscle::gain_m_per_W && member != &Muscle::time_constant_s) continue;
    const double apart = first.muscle.*member - second.muscle.*member;
    const double deviations = std::abs(apart) / first.deviation(i);
    if (deviations >= result.deviations)
      result = {i, second.muscle.*member / (first.muscle.*member), deviations};
  }
  return result;
}

}  // namespace supercoil::identification
