#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "supercoil/identification/units.hpp"

#include "apps/supercoil/identify/findings.hpp"

namespace supercoil::operating {

namespace {

using identification::Comparison;
using identification::EvaluatedModel;
using identification::Fit;
using identification::time_text;

/// With less motion than this share of the stroke, no model can be judged.
constexpr double min_stroke_ratio = 0.1;

// NOLINTNEXTLINE(cert-dcl50-cpp): printf's own form
[[gnu::format(printf, 2, 3)]] void print(std::string& text, const char* format, ...) {
  std::array<char, 600> line{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  text += line.data();
}

void add_model(std::string& text, const Comparison& c, const EvaluatedModel& model, bool chosen) {
  const double percent = 100.0 / c.sizes.stroke_m;
  print(text, "%s %-42s %7.2f %8.2f %8.2f %8.2f %%", chosen ? "*" : " ",
        name(model.fit.effects).c_str(), model.fitted_rms_m * percent,
        model.fit.cross_validated_m * percent, model.unseen_rms_m * percent,
        100.0 * model.fitted_explained);
  if (c.unseen_stroke_ratio < min_stroke_ratio) {
    print(text, "        –\n");
  } else {
    print(text, " %8.2f %%\n", 100.0 * model.unseen_explained);
  }
}

void add_models(std::string& text, const Comparison& c) {
  print(text, "\n%-44s %7s %8s %8s %19s\n", "", "", "left", "", "motion explained");
  print(text, "%-44s %7s %8s %8s %10s %10s\n", "  error in % of the stroke (rms)", "fitted", "out",
        "unseen", "fitted", "unseen");
  for (std::size_t i = 0; i < c.models.size(); ++i)
    add_model(text, c, c.models[i], i == c.chosen && c.rejection_reason.empty());
  add_model(text, c, c.transformation, false);
  if (c.unseen_stroke_ratio < min_stroke_ratio) {
    print(text,
          "The unseen part moves by only %.1f %% of the stroke and judges little: choose another "
          "with --fit and --judge.\n",
          100.0 * c.unseen_stroke_ratio);
  }
}

void add_value(std::string& text, const Fit& fit, std::size_t i) {
  const double value = fit.muscle.*fit.parameters[i].member;
  print(text, " %11.4g ± %-9.2g", value, fit.deviation(i));
}

/// A model's parameters, fitted to the fitted part and to the whole recording.
void add_parameters(std::string& text, const Fit& part, const Fit& whole) {
  print(text, "\n%-31s %23s %23s\n", (name(part.effects) + ":").c_str(), "fitted part",
        "whole recording");
  for (std::size_t i = 0; i < part.parameters.size(); ++i) {
    if (!part.parameters[i].of_muscle) continue;
    print(text, "  %-29s", std::string(part.parameters[i].name).c_str());
    add_value(text, part, i);
    add_value(text, whole, i);
    text += is_determined(whole, i) ? "\n" : " not determined\n";
  }
}

void add_change(std::string& text, const Findings& f) {
  const auto change = identification::max_change(f.linear_first, f.linear);
  const std::string what(f.linear.parameters[change.parameter].name);
  const double percent = 100.0 * (change.ratio - 1.0);
  if (change.deviations <= 3.0) {
    print(text,
          "No change: %s moves by %+.1f %%, %.1f standard deviations, when the rest is included.\n",
          what.c_str(), percent, change.deviations);
  } else {
    print(text,
          "%s moves by %+.1f %%, %.1f standard deviations, when the rest is included: the muscle "
          "changed, or one linear model does not hold for all of the recording.\n",
          what.c_str(), percent, change.deviations);
  }
}

void add_theta(std::string& text, const Findings& f) {
  const auto theta = identification::theta_of(f.linear, f.assumed);
  print(text, "θ of the whole recording, of %s:", name(f.linear.effects).c_str());
  for (int i = 0; i < 4; ++i)
    print(text, "%s %.4g ± %.2g", i > 0 ? "," : "", theta.theta[i], theta.deviation[i]);
  text += "\n";
}

}  // namespace

bool is_determined(const Fit& fit, std::size_t parameter) {
  const auto i = static_cast<Eigen::Index>(parameter);
  return std::sqrt(fit.covariance(i, i)) < 0.7 * fit.parameters[parameter].deviation;
}

std::string report(const Findings& f) {
  const Comparison& c = f.comparison;
  std::string text;
  print(text, "%s: %zu rows, %s to %s s, used at %.4g Hz; stroke %.4g mm, power up to %.4g W\n",
        f.file.c_str(), f.rows, time_text(f.samples.start_s).c_str(),
        time_text(f.samples.end_s()).c_str(), 1.0 / f.samples.step_s, 1e3 * c.sizes.stroke_m,
        c.sizes.full_W);
  print(text,
        "Fitted to %s to %s s, judged by %s to %s s, which no fit has seen. Left out: each\n"
        "fifth of the fitted part, predicted by a fit to the others. Both choose the model (*).\n",
        time_text(c.parts.fitted.from_s).c_str(), time_text(c.parts.fitted.to_s).c_str(),
        time_text(c.parts.unseen.from_s).c_str(), time_text(c.parts.unseen.to_s).c_str());
  add_models(text, c);
  if (!c.rejection_reason.empty()) {
    text += "\nNo model is accepted: " + c.rejection_reason + ".\n";
    return text;
  }
  add_parameters(text, c.best().fit, f.whole);
  if (!(f.linear.effects == f.whole.effects)) add_parameters(text, f.linear_first, f.linear);
  text += "Standard deviations include the model's own error.\n";
  add_change(text, f);
  add_theta(text, f);
  return text;
}

}  // namespace supercoil::operating
