// Equal muscles that pull together under one heater, and what happens when one of them is lost.
#pragma once

#include "loop/settings.hpp"

namespace supercoil::config {

/// How a bundle's muscles are connected to their one heater output.
enum class Wiring { series, parallel };

/// To the loop, a bundle is one muscle.
struct Bundle {
  int muscles = 2;  ///< 2 to 32
  Wiring wired = Wiring::series;

  bool parallel() const { return wired == Wiring::parallel; }
  /// By which ratio the bundle's resistance rises when one of its parallel threads breaks, or falls
  /// when one of its threads in series is shorted.
  double one_lost_ratio() const { return parallel() ? 1.0 / (muscles - 1) : 1.0 / muscles; }
  /// The power that each of the others then gets, over its assumed share.
  double others_power_ratio() const { return static_cast<double>(muscles) / (muscles - 1); }
  /// The largest such change that resistance_drift lets pass: by its bounds, a cold muscle may be
  /// as hot as the limit, and a hot one cold.
  double undetected_ratio(const ChannelSettings& channel) const;
};

}  // namespace supercoil::config
