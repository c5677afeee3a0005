#include "scenario/reference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace supercoil::host_sim {

namespace {

double reach(const std::vector<Sinusoid>& terms) {
  double sum = 0.0;
  for (const Sinusoid& term : terms)
    sum += std::abs(term.amplitude);
  return sum;
}

bool has_levels(ReferenceKind kind) {
  return kind == ReferenceKind::step || kind == ReferenceKind::steps;
}

}  // namespace

double Reference::at(double time_s) const {
  if (kind == ReferenceKind::step) return time_s < hold_s ? levels[0] : levels[1];
  if (kind == ReferenceKind::steps) {
    const double turn = std::fmod(time_s / hold_s, static_cast<double>(levels.size()));
    return levels[std::min(static_cast<std::size_t>(turn), levels.size() - 1)];
  }
  double value = offset;
  for (const Sinusoid& term : terms) {
    value += term.amplitude * std::sin(term.angular_frequency_rad_per_s * time_s);
  }
  return value;
}

double Reference::min() const {
  return has_levels(kind) ? *std::min_element(levels.begin(), levels.end()) : offset - reach(terms);
}

double Reference::max() const {
  return has_levels(kind) ? *std::max_element(levels.begin(), levels.end()) : offset + reach(terms);
}

double Reference::min_period_s() const {
  if (kind == ReferenceKind::steps) return hold_s;
  double min_s = INFINITY;
  if (has_levels(kind)) return min_s;
  for (const Sinusoid& term : terms) {
    const double angular_frequency = std::abs(term.angular_frequency_rad_per_s);
    min_s = std::fmin(min_s, 2.0 * std::numbers::pi / angular_frequency);
  }
  return min_s;
}

Reference paper_excitation() {
  return {ReferenceKind::power, 2.5, {{1.0, 1.0}, {1.0, 0.5}, {1.0, 0.25}}, {}, 20.0};
}

}  // namespace supercoil::host_sim
