#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "supercoil/identification/comparison.hpp"
#include "supercoil/identification/units.hpp"

namespace supercoil::identification {

namespace {

/// It is a shape-memory wire if that model's error is below this ratio of the best other model's,
/// and the latter above min_error_ratio.
constexpr double transformation_ratio = 0.6;
constexpr double min_error_ratio = 0.005;
/// Error on unseen data over the stroke, above which no model explains the motion.
constexpr double max_error_ratio = 0.15;
/// The same of a part to which the model was fitted, below which it explains that part.
constexpr double explained_error_ratio = 0.05;
/// A recording of long_enough time constants is long enough, one of less than too_short is not;
/// between them the time constant's deviation decides, which is at most this ratio of it.
constexpr double long_enough = 5.0;
constexpr double too_short = 2.0;
constexpr double max_deviation_ratio = 0.3;
/// Time constants that are recommended.
constexpr double recommended_length = 10.0;

// NOLINTNEXTLINE(cert-dcl50-cpp): printf's own form
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* format, ...) {
  std::array<char, 500> text{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

std::string transformation_text(const Comparison& c) {
  double best_m = std::numeric_limits<double>::infinity();
  for (const EvaluatedModel& model : c.models)
    best_m = std::min(best_m, overall_rms(model));
  const double transformed_m = overall_rms(c.transformation);
  const bool transforms =
      best_m > min_error_ratio * c.sizes.stroke_m && transformed_m < transformation_ratio * best_m;
  if (!transforms) return {};
  return format_text(
      "this is not a super-coiled polymer muscle: nearly all of its stroke lies within a narrow "
      "range of heat, and heat below or above that range hardly moves it: a material that "
      "transforms, such as shape-memory wire, or an end stop. Such a model is off by %.2f %% of "
      "the stroke (rms), the best model of a super-coiled polymer muscle by %.2f %%",
      100.0 * transformed_m / c.sizes.stroke_m, 100.0 * best_m / c.sizes.stroke_m);
}

std::string limit_text(const Fit& fit) {
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const Parameter& p = fit.parameters[i];
    if (p.member != &Muscle::time_constant_s && p.member != &Muscle::gain_m_per_W) continue;
    if (!is_at_limit(p, fit.numbers[static_cast<Eigen::Index>(i)])) continue;
    return format_text(
        "the fit ended at its limit of %s, %.3g: slower, faster or weaker than any super-coiled "
        "polymer muscle, the recording is too short (record ten time constants), or the times or "
        "powers have another unit",
        std::string(p.name).c_str(), fit.muscle.*p.member);
  }
  return {};
}

/// Whether a linear muscle explains the motion with the opposite sign.
bool counts_backwards(const Comparison& c, Samples samples) {
  for (double& position_m : samples.position_m)
    position_m = -position_m;
  const auto linear = evaluate(fit_model({}, samples, c.parts.fitted), samples, c.parts);
  return linear.unseen_rms_m <= max_error_ratio * c.sizes.stroke_m;
}

std::string span_text(Span span) {
  return time_text(span.from_s) + " to " + time_text(span.to_s) + " s";
}

/// When the best model explains each part with other parameters.
std::string change_text(const Comparison& c, const Samples& samples) {
  const Fit& first = c.best().fit;
  const Fit second = refit(first.muscle, first.effects, samples, c.parts.unseen);
  const double limit_m = explained_error_ratio * c.sizes.stroke_m;
  if (first.rms_m > limit_m || second.rms_m > limit_m) return {};
  const Change change = max_change(first, second);
  return format_text(
      "the muscle changed between %s and %s: %s by %+.0f %%. Use a part in which it does not "
      "change (--from, --to)",
      span_text(c.parts.fitted).c_str(), span_text(c.parts.unseen).c_str(),
      std::string(first.parameters[change.parameter].name).c_str(), 100.0 * (change.ratio - 1.0));
}

/// By the time constant of the linear model, fitted to all of the recording.
std::string short_text(const Comparison& c, const Samples& samples) {
  const Span all{samples.start_s, samples.end_s()};
  const Fit& first = c.models.front().fit;
  const Fit fit = refit(first.muscle, first.effects, samples, all);
  double deviation_s = 0.0;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].member == &Muscle::time_constant_s) deviation_s = fit.deviation(i);
  const double tau_s = fit.muscle.time_constant_s;
  const double duration_s = all.to_s - all.from_s;
  const bool is_known = deviation_s <= max_deviation_ratio * tau_s;
  if (duration_s >= (is_known ? too_short : long_enough) * tau_s) return {};
  return format_text(
      "%.3g s are too short: they leave a time constant of %.2g ± %.2g s. Record ten time "
      "constants, here about %.2g s, in which the muscle warms up and cools down several times",
      duration_s, tau_s, deviation_s, recommended_length * (tau_s + deviation_s));
}

}  // namespace

std::string why_rejected(const Comparison& c, const Samples& samples) {
  if (std::string text = transformation_text(c); !text.empty()) return text;
  const EvaluatedModel& best = c.best();
  std::string limit = limit_text(best.fit);
  if (limit.empty() && best.unseen_rms_m <= max_error_ratio * c.sizes.stroke_m)
    return short_text(c, samples);
  if (counts_backwards(c, samples))
    return "the position falls when the muscle is heated: give --position-scale -1";
  if (!limit.empty()) return limit;
  if (std::string text = short_text(c, samples); !text.empty()) return text;
  if (std::string text = change_text(c, samples); !text.empty()) return text;
  return format_text(
      "no model predicts the part that it was not fitted to: the best is off by %.0f %% of the "
      "stroke (rms) there, and by %.1f %% where it was fitted. Something other than power may "
      "move it, or something changed between the parts",
      100.0 * best.unseen_rms_m / c.sizes.stroke_m, 100.0 * best.fitted_rms_m / c.sizes.stroke_m);
}

}  // namespace supercoil::identification
