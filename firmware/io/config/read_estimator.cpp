#include "config/read_control.hpp"

namespace supercoil::config {

namespace {

control::Theta read_four(Section& section, const char* key, const control::Theta& fallback,
                         Range range) {
  const auto list =
      section.numbers(key, {fallback[0], fallback[1], fallback[2], fallback[3]}, range, 4, 4);
  return control::Theta{list[0], list[1], list[2], list[3]};
}

void read_gradient(Section& section, control::GradientSettings& g) {
  g.gain = read_four(section, "gain", g.gain, {1e-6, 1e12});
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
  g.normalisation = section.number("normalisation", g.normalisation, {0.0, 1e6});
}

void read_least_squares(Section& section, control::LeastSquaresSettings& s) {
  s.initial = read_four(section, "initial", s.scale.nominal, {0.0, 1e9});
  s.forgetting_s = section.number("forgetting_s", s.forgetting_s, {1.0, 3600.0});
  s.min_ratio = section.number("min_ratio", s.min_ratio, {1e-3, 1.0});
  s.max_ratio = section.number("max_ratio", s.max_ratio, {1.0, 1e3});
  s.max_bias_W = section.number("max_bias_W", s.max_bias_W, {0.0, 1e3});
  s.position_noise_m = section.number("position_noise_m", s.position_noise_m, {1e-9, 1e-2});
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
  if (!control::supported(e.kind, e.arithmetic)) {
    section.wrong("arithmetic",
                  "must be double or float: the covariance of least_squares does not fit q8.24");
  }
  e.set_nominal(muscle, max_W);
  if (e.kind == control::EstimatorKind::gradient) {
    read_gradient(section, e.gradient);
    e.excitation.window_s = section.number("window_s", e.excitation.window_s, {0.1, 3600.0});
  } else {
    read_least_squares(section, e.least_squares);
  }
  e.excitation.trusted_error =
      section.number("trusted_error", e.excitation.trusted_error, {1e-6, 1e3});
  section.finish();
  return e;
}

}  // namespace supercoil::config
