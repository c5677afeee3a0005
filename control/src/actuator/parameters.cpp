#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::control {

std::optional<Violation> check(const PhysicalParameters& parameters) {
  for (const PhysicalRange& range : physical_ranges) {
    const double value = parameters.*range.member;
    // Written so that a NaN fails.
    if (!(value >= range.min && value <= range.max)) {
      return Violation{range.name, value, range.min, range.max};
    }
  }
  return std::nullopt;
}

}  // namespace supercoil::control
