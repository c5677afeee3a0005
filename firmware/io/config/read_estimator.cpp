#include "config/read_control.hpp"
#include "loop/settings.hpp"

namespace supercoil::config {

namespace {

control::Theta theta_of(const std::vector<double>& list) {
  return {list[0], list[1], list[2], list[3]};
}

control::Theta read_four(Section& section, const char* key, const control::Theta& fallback,
                         Range range) {
  return theta_of(
      section.numbers(key, {fallback[0], fallback[1], fallback[2], fallback[3]}, range, 4, 4));
}

/// Reads the values that are lists.
void read_gradient(Section& section, control::GradientSettings& g) {
  g.gain = read_four(section, "gain", g.gain, range_of_tunable("gain_1"));
  g.initial = read_four(section, "initial", g.initial, {-1e9, 1e9});
  const auto lower = section.numbers("lower", {}, {-1e9, 1e9}, 4, 4);
  const auto upper = section.numbers("upper", {}, {-1e9, 1e9}, 4, 4);
  if (lower.empty() && upper.empty()) return;
  g.bounds = control::Box<double, 4>{
      lower.empty() ? control::Theta(g.scale.nominal * 0.1) : theta_of(lower),
      upper.empty() ? control::Theta(g.scale.nominal * 10.0) : theta_of(upper)};
  if ((g.bounds->lower.array() > g.bounds->upper.array()).any()) {
    section.wrong(section.has("lower") ? "lower" : "upper", "lower must not exceed upper");
  }
}

}  // namespace

control::EstimatorSettings read_estimator(Section& section,
                                          const control::PhysicalParameters& muscle, double max_W) {
  control::EstimatorSettings e;
  e.kind = section.choice("kind", e.kind, control::estimator_names);
  if (e.kind == control::EstimatorKind::none) {
    section.finish();
    return e;
  }
  e.arithmetic = section.choice("arithmetic", e.arithmetic, control::arithmetic_names);
  for (const SettingsProblem& problem : contradictions(e))
    section.wrong(problem.key, problem.message);
  e.set_nominal(muscle, max_W);
  if (e.kind == control::EstimatorKind::gradient) {
    read_gradient(section, e.gradient);
  } else {
    auto& initial = e.least_squares.initial;
    initial = read_four(section, "initial", e.least_squares.scale.nominal, {0.0, 1e9});
  }
  read_tunables(section, e);
  section.finish();
  return e;
}

}  // namespace supercoil::config
