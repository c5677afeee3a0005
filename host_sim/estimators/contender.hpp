// The estimators that are compared, behind a common interface.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::host_sim::estimators {

class Contender {
 public:
  Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;
  Contender(Contender&&) = delete;
  Contender& operator=(Contender&&) = delete;
  virtual ~Contender() = default;

  /// One tick: this tick's position, and the power that acted since the last one.
  virtual void step(double position_m, double power_W) = 0;
  virtual control::Theta theta() const = 0;
  /// The standard deviations that it reports, relative to θ; NaN if it reports none.
  virtual control::Theta standard_deviations() const;
};

struct ContenderKind {
  std::string_view name;
  std::string_view meaning;
  std::unique_ptr<Contender> (*make)(const control::Theta& initial, double step_s);
};

/// In the order of the tables.
inline constexpr std::size_t contender_count = 5;
extern const std::array<ContenderKind, contender_count> contenders;

/// The forgetting time of estimators that have one, and the window for computing their bound:
/// exponential forgetting scatters as much as a window of twice its time.
inline constexpr double forgetting_s = 30.0;
inline constexpr double bound_window_s = 2.0 * forgetting_s;

}  // namespace supercoil::host_sim::estimators
