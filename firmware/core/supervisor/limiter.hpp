// Limits the demanded power, and reports which limit acted.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace supercoil {

/// Not faults: conditions that limit the demanded power.
enum class LimitedBy : std::uint8_t {
  nothing = 0,
  minimum = 1,      ///< less than min_W was demanded: a muscle cools at its own pace
  maximum = 2,      ///< the channel's maximum power
  slew = 3,         ///< power may not rise faster
  temperature = 4,  ///< derated: the muscle is near its limit
  invalid = 5,      ///< the demand is not finite, or the temperature NaN; no power is given
  cooling = 6,      ///< the reference falls faster than the muscle cools, and was shaped
  unproven = 7,     ///< more is not safe for a muscle that has not proven that it answers
};

inline constexpr std::array<std::string_view, 8> limit_names{
    "nothing", "minimum", "maximum", "slew", "temperature", "invalid", "cooling", "unproven"};
constexpr std::string_view name(LimitedBy limit) {
  return limit_names[static_cast<std::size_t>(limit)];
}

/// Limits of a channel's power; derate_from_C < derate_to_C.
struct LimiterSettings {
  double max_W = 4.5;
  double min_W = 0.0;            ///< while active; more than 0 is for experiments only
  double slew_W_per_s = 1e6;     ///< of rises; falls are not limited
  double derate_from_C = 130.0;  ///< full power up to here,
  double derate_to_C = 160.0;    ///< none from here on (the trip temperature); nylon softens above
};

/// Keeps the demanded power within its range, its slew rate, and what the temperature allows.
class Limiter {
 public:
  /// The power to give, and what made it differ from the demand.
  struct Result {
    double power_W = 0.0;
    LimitedBy by = LimitedBy::nothing;
  };

  Limiter(const LimiterSettings& settings, double step_s)
      : settings_(settings), rise_W_(settings.slew_W_per_s * step_s) {}

  /// temperature_C: the hottest that the muscle may be; NaN gives no power.
  Result step(double demanded_W, double temperature_C);
  /// Instead of the configured range; set_cap() and set_unproven() hold as well.
  void set_range(double min_W, double max_W) {
    settings_.min_W = min_W;
    settings_.max_W = max_W;
  }
  /// From an operator: a lower maximum than the configured one.
  void set_cap(double cap_W) { cap_W_ = cap_W; }
  /// The maximum for what the muscle has proven so far.
  void set_unproven(double max_W) { unproven_W_ = max_W; }
  double min_W() const { return settings_.min_W; }
  double max_W() const { return cap_W_ < settings_.max_W ? cap_W_ : settings_.max_W; }
  /// The same, derated for a muscle that may be this hot.
  double max_W(double temperature_C) const;
  /// The channel was made safe: the next rise starts from zero.
  void reset() { last_W_ = 0.0; }

 private:
  LimiterSettings settings_;
  double rise_W_;
  double cap_W_ = std::numeric_limits<double>::infinity();
  double unproven_W_ = std::numeric_limits<double>::infinity();
  double last_W_ = 0.0;
};

}  // namespace supercoil
