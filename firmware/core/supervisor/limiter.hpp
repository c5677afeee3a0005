// What is left of the wanted power, and which limit took the rest.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace supercoil {

/// Not faults: conditions under which less is given than was wanted.
enum class LimitedBy : std::uint8_t {
  nothing = 0,
  minimum = 1,      ///< less than the least power was wanted: a muscle cools at its own pace
  maximum = 2,      ///< the channel's greatest power
  slew = 3,         ///< power may not rise faster
  temperature = 4,  ///< derated: the muscle is near its limit
  invalid = 5,      ///< the wanted power was no number; none is given
  cooling = 6,      ///< the reference falls faster than the muscle cools, and was shaped
  unproven = 7,     ///< no more is safe for a muscle that has not proven that it answers
};

inline constexpr std::array<std::string_view, 8> limit_names{
    "nothing", "minimum", "maximum", "slew", "temperature", "invalid", "cooling", "unproven"};
constexpr std::string_view name(LimitedBy limit) {
  return limit_names[static_cast<std::size_t>(limit)];
}

struct LimiterSettings {
  double max_W = 4.5;
  double min_W = 0.0;            ///< while active; more than 0 is for experiments only
  double slew_W_per_s = 1e6;     ///< of rises; falls are never slowed
  double derate_from_C = 130.0;  ///< full power up to here,
  double derate_to_C = 160.0;  ///< none from here on (the trip's temperature); nylon softens above
};

class Limiter {
 public:
  struct Result {
    double power_W = 0.0;
    LimitedBy by = LimitedBy::nothing;
  };

  Limiter(const LimiterSettings& settings, double step_s)
      : settings_(settings), rise_W_(settings.slew_W_per_s * step_s) {}

  /// temperature_C: the hottest that the muscle may be. A temperature that is NaN gives no
  /// power.
  Result step(double demanded_W, double temperature_C);
  void set_range(double min_W, double max_W) {
    settings_.min_W = min_W;
    settings_.max_W = max_W;
  }
  /// From an operator: a lower maximum than the configured one.
  void set_cap(double cap_W) { cap_W_ = cap_W; }
  /// What a muscle may have by what it has proven.
  void set_unproven(double max_W) { unproven_W_ = max_W; }
  double min_W() const { return settings_.min_W; }
  double max_W() const { return cap_W_ < settings_.max_W ? cap_W_ : settings_.max_W; }
  /// The same for a muscle that may be so hot.
  double max_W(double temperature_C) const;
  /// The channel was made safe: the next rise starts from nothing.
  void reset() { last_W_ = 0.0; }

 private:
  LimiterSettings settings_;
  double rise_W_;
  double cap_W_ = std::numeric_limits<double>::infinity();
  double unproven_W_ = std::numeric_limits<double>::infinity();
  double last_W_ = 0.0;
};

}  // namespace supercoil
