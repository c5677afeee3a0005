#include "supercoil/control/actuator/conversions.hpp"

#include "config/read_control.hpp"

namespace supercoil::config {

control::EstimatorSettings read_estimator(Section& section,
                                          const control::PhysicalParameters& muscle) {
  control::EstimatorSettings e;
  e.kind = section.choice("kind", e.kind, control::estimator_names);
  if (e.kind == control::EstimatorKind::none) {
    section.finish();
    return e;
  }
  e.arithmetic = section.choice("arithmetic", e.arithmetic, control::arithmetic_names);
  control::GradientSettings& g = e.gradient;
  g.scale = {control::theta_from(muscle), muscle.dc_gain_m_per_W(), muscle.moving_mass_kg};
  const auto four = [&](const char* key, const control::Theta& fallback, Range range) {
    const auto list =
        section.numbers(key, {fallback[0], fallback[1], fallback[2], fallback[3]}, range, 4, 4);
    return control::Theta{list[0], list[1], list[2], list[3]};
  };
  g.gain = four("gain", g.gain, {1e-6, 1e12});
  g.initial = four("initial", g.initial, {-1e9, 1e9});
  if (section.has("lower") || section.has("upper")) {
    g.bounds = control::Box<double, 4>{four("lower", g.scale.nominal * 0.1, {-1e9, 1e9}),
                                       four("upper", g.scale.nominal * 10.0, {-1e9, 1e9})};
    if ((g.bounds->lower.array() > g.bounds->upper.array()).any()) {
      section.wrong(section.has("lower") ? "lower" : "upper", "lower must not exceed upper");
    }
  } else {
    section.numbers("lower", {}, {0.0, 0.0}, 0, 0);
    section.numbers("upper", {}, {0.0, 0.0}, 0, 0);
  }
  g.normalisation = section.number("normalisation", g.normalisation, {0.0, 1e6});
  e.excitation.window_s = section.number("window_s", e.excitation.window_s, {0.1, 3600.0});
  e.excitation.trusted_error =
      section.number("trusted_error", e.excitation.trusted_error, {1e-6, 1e3});
  section.finish();
  return e;
}

}  // namespace supercoil::config
