#include "apps/supercoil/setup/other_muscle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <nlohmann/json.hpp>

#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

/// An index into known_quantities, which also has the figure's name.
struct Figure {
  std::string_view step;
  std::size_t quantity;
};
constexpr std::array<Figure, 8> figures{{{"calibrate", known_position_offset},
                                         {"calibrate", known_cold_resistance},
                                         {"identify", 0},
                                         {"identify", 1},
                                         {"identify", 2},
                                         {"identify", 3},
                                         {"identify", 4},
                                         {"identify", 5}}};

constexpr double rounding_ratio = 1e-5;
/// A zero position may be close to 0.
constexpr double min_difference = 1e-9;
constexpr int digits_compared = 5;

bool differs(double recorded, double now) {
  const double rounding = std::max(min_difference, rounding_ratio * std::abs(recorded));
  return !(std::abs(now - recorded) <= rounding);
}

}  // namespace

bool has_muscle_findings(const SetupRecord& record) {
  return std::ranges::any_of(figures, [&](const Figure& figure) {
    const auto found = record.found(std::string(figure.step));
    return found.is_object() && found.contains(std::string(known_quantities[figure.quantity]));
  });
}

std::optional<OtherMuscle> other_muscle(const SetupRecord& record, const KnownMuscle& known) {
  for (const auto& [step, quantity] : figures) {
    const std::string name(known_quantities[quantity]);
    const auto found = record.found(std::string(step));
    if (!found.is_object() || !found.contains(name) || !found[name].is_number()) continue;
    const double recorded = found[name].get<double>();
    if (!differs(recorded, known[quantity])) continue;
    return OtherMuscle{std::string(step),
                       std::string(step) +
                           " and all later steps must be repeated: the board uses " + name + " = " +
                           number_text(known[quantity], digits_compared) + ", and " +
                           record.path() + " has " + number_text(recorded, digits_compared) +
                           ": it is another board or muscle, or has lost what it had learned"};
  }
  return std::nullopt;
}

}  // namespace supercoil::operating
