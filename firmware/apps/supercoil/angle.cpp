#include "apps/supercoil/angle.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

namespace supercoil::operating {

std::optional<double> degrees_of(std::string_view text) {
  constexpr std::string_view unit = "deg";
  if (!text.ends_with(unit)) return std::nullopt;
  text.remove_suffix(unit.size());
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool number = error == std::errc{} && end == text.data() + text.size();
  return number && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double metres_per_degree(const KnownMuscle& muscle) {
  return muscle[known_joint_lever] * std::numbers::pi / 180.0;
}

}  // namespace supercoil::operating
