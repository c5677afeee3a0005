#include <array>

#include "scenario/read_tables.hpp"

namespace supercoil::host_sim {

namespace {

using config::Range;
using config::Section;

constexpr Range allowed_position_m{-10.0, 10.0};
constexpr Range amplitude_m{0.0, 10.0};
constexpr Range allowed_power_W{-1e3, 1e3};
constexpr Range frequency_rad_per_s{1e-4, 1e3};
constexpr std::size_t max_terms = 32;

/// In m.
struct Defaults {
  double offset;
  double amplitude;
  double to;
  std::vector<double> levels;
  std::array<double, 2> amplitudes;
};

Defaults defaults_of(Moves moves) {
  switch (moves) {
    case Moves::joint:
      return {0.0, 0.005, 0.005, {0.003, -0.004, 0.002, -0.005}, {0.003, 0.002}};
    case Moves::spring_joint:
      return {0.004, 0.003, 0.005, {0.003, 0.006, 0.002, 0.005}, {0.002, 0.001}};
    case Moves::paper_load:
    case Moves::load:
      break;
  }
  return {Reference{}.offset, 0.009, 0.011, {0.005, 0.015, 0.008, 0.020}, {0.004, 0.003}};
}

std::vector<Sinusoid> read_terms(Section& section, const char* amplitudes_key, Range amplitudes,
                                 const std::vector<Sinusoid>& fallback) {
  std::vector<double> sizes;
  std::vector<double> frequencies;
  for (const Sinusoid& term : fallback) {
    sizes.push_back(term.amplitude);
    frequencies.push_back(term.angular_frequency_rad_per_s);
  }
  sizes = section.numbers(amplitudes_key, sizes, amplitudes, 1, max_terms);
  frequencies = section.numbers("angular_frequencies_rad_per_s", frequencies, frequency_rad_per_s,
                                1, max_terms);
  if (sizes.size() != frequencies.size()) {
    section.wrong("angular_frequencies_rad_per_s", "must have as many values as " +
                                                       std::string(amplitudes_key) + ": " +
                                                       std::to_string(sizes.size()));
    return fallback;
  }
  std::vector<Sinusoid> terms;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    terms.push_back({sizes[i], frequencies[i]});
  return terms;
}

}  // namespace

Reference read_reference(Section& section, Moves moves) {
  Reference r;
  const Defaults defaults = defaults_of(moves);
  r.kind = section.choice("kind", r.kind, reference_names);
  switch (r.kind) {
    case ReferenceKind::sine:
      r.offset = section.number("offset_m", defaults.offset, allowed_position_m);
      r.terms = {{section.number("amplitude_m", defaults.amplitude, amplitude_m),
                  section.number("angular_frequency_rad_per_s", 0.25, frequency_rad_per_s)}};
      break;
    case ReferenceKind::step:
      r.levels = {section.number("from_m", 0.0, allowed_position_m),
                  section.number("to_m", defaults.to, allowed_position_m)};
      r.hold_s = section.number("at_s", 0.0, {0.0, 1e6});
      break;
    case ReferenceKind::steps:
      r.levels = section.numbers("levels_m", defaults.levels, allowed_position_m, 1, max_terms);
      r.hold_s = section.number("hold_s", 20.0, {1e-3, 1e6});
      break;
    case ReferenceKind::multisine:
      r.offset = section.number("offset_m", defaults.offset, allowed_position_m);
      r.terms = read_terms(section, "amplitudes_m", amplitude_m,
                           {{defaults.amplitudes[0], 0.25}, {defaults.amplitudes[1], 0.6}});
      break;
    case ReferenceKind::power: {
      const Reference paper = paper_excitation();
      r.offset = section.number("offset_W", paper.offset, allowed_power_W);
      r.terms = read_terms(section, "amplitudes_W", allowed_power_W, paper.terms);
      break;
    }
  }
  section.finish();
  return r;
}

}  // namespace supercoil::host_sim
