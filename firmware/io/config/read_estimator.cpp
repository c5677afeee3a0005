#include "config/read_control.hpp"
#include "loop/settings.hpp"

namespace supercoil::config {

namespace {

control::Theta read_four(Section& section, const char* key, const control::Theta& fallback,
                         Range range) {
  const auto list =
      section.numbers(key, {fallback[0], fallback[1], fallback[2], fallback[3]}, range, 4, 4);
  return control::Theta{list[0], list[1], list[2], list[3]};
}

/// Reads the values that are lists.
void read_gradient(Section& section, control::GradientSettings& g) {
  const control::Tunable& gain = control::tunables()[control::tunable_named("gain_1")];
  g.gain = read_four(section, "gain", g.gain, {gain.min, gain.max});
  g.initial = read_four(section, "initial", g.initial, {-1e9, 1e9});
  if (section.has("lower") || section.has("upper")) {
    g.bounds =
        control::Box<double, 4>{read_four(section, "lower", g.scale.nominal * 0.1, {-1e9, 1e9}),
                                read_four(section, "upper", g.scale.nominal * 10.0, {-1e9, 1e9})};
    if ((g.bounds->lower.array() > g.bounds->upper.array()).any()) {
      section.wrong(section.has("lower") ? "lower" : "upper", "lower must not exceed upper");
    }
  } else {
    section.numbers("lower", {}, {0.0, 0.0}, 0, 0);
    section.numbers("upper", {}, {0.0, 0.0}, 0, 0);
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
