#include "scenario/read_control.hpp"

#include <algorithm>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::host_sim {

namespace {

using config::Range;
using config::Section;

constexpr Range position_m{-10.0, 10.0};
constexpr Range amplitude_m{0.0, 10.0};
constexpr Range power_W{-1e3, 1e3};
constexpr Range frequency_rad_per_s{1e-4, 1e3};
constexpr std::size_t most_terms = 32;

std::vector<Sinusoid> read_terms(Section& section, const char* amplitudes_key, Range amplitudes,
                                 const std::vector<Sinusoid>& fallback) {
  std::vector<double> sizes;
  std::vector<double> frequencies;
  for (const Sinusoid& term : fallback) {
    sizes.push_back(term.amplitude);
    frequencies.push_back(term.angular_frequency_rad_per_s);
  }
  sizes = section.numbers(amplitudes_key, sizes, amplitudes, 1, most_terms);
  frequencies = section.numbers("angular_frequencies_rad_per_s", frequencies, frequency_rad_per_s,
                                1, most_terms);
  if (sizes.size() != frequencies.size()) {
    section.wrong("angular_frequencies_rad_per_s", "must be as many as " +
                                                       std::string(amplitudes_key) +
                                                       " has: " + std::to_string(sizes.size()));
    return fallback;
  }
  std::vector<Sinusoid> terms;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    terms.push_back({sizes[i], frequencies[i]});
  return terms;
}

}  // namespace

Reference read_reference(Section& section) {
  Reference r;
  r.kind = section.choice("kind", r.kind, reference_names);
  switch (r.kind) {
    case ReferenceKind::sine:
      r.offset = section.number("offset_m", r.offset, position_m);
      r.terms = {{section.number("amplitude_m", 0.009, amplitude_m),
                  section.number("angular_frequency_rad_per_s", 0.25, frequency_rad_per_s)}};
      break;
    case ReferenceKind::step:
      r.levels = {section.number("from_m", 0.0, position_m),
                  section.number("to_m", 0.011, position_m)};
      r.hold_s = section.number("at_s", 0.0, {0.0, 1e6});
      break;
    case ReferenceKind::steps:
      r.levels =
          section.numbers("levels_m", {0.005, 0.015, 0.008, 0.020}, position_m, 1, most_terms);
      r.hold_s = section.number("hold_s", 20.0, {1e-3, 1e6});
      break;
    case ReferenceKind::multisine:
      r.offset = section.number("offset_m", r.offset, position_m);
      r.terms = read_terms(section, "amplitudes_m", amplitude_m, {{0.004, 0.25}, {0.003, 0.6}});
      break;
    case ReferenceKind::power: {
      const Reference paper = paper_excitation();
      r.offset = section.number("offset_W", paper.offset, power_W);
      r.terms = read_terms(section, "amplitudes_W", power_W, paper.terms);
      break;
    }
  }
  section.finish();
  return r;
}

std::optional<control::ReferenceModelSettings> read_reference_model(Section section) {
  enum class Kind { design, eq8, wm16, poles };
  static constexpr control::Names<Kind, 4> names{
      {{"design", Kind::design}, {"eq8", Kind::eq8}, {"wm16", Kind::wm16}, {"poles", Kind::poles}}};
  if (!section.has("kind") && !section.has("poles_rad_per_s")) {
    section.text("kind", "");
    section.finish();
    return std::nullopt;
  }
  const Kind kind = section.choice("kind", Kind::poles, names);
  if (kind == Kind::poles) {
    if (!section.has("poles_rad_per_s")) section.wrong("kind", "needs poles_rad_per_s = [a, b, c]");
    const auto poles = section.numbers("poles_rad_per_s", {4.0, 5.0, 0.8}, {1e-3, 1e3}, 3, 3);
    section.finish();
    return control::poles_model({poles[0], poles[1], poles[2]});
  }
  section.finish();
  return control::reference_model_named(control::name_of(names, kind));
}

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

}  // namespace supercoil::host_sim
