// Equal muscles that pull together under one heater, and what happens when one of them is lost.
#pragma once

#include "loop/settings.hpp"

namespace supercoil::config {

enum class Wiring { series, parallel };

/// To the loop they are one muscle.
struct Bundle {
  int muscles = 2;  ///< 2 to 32
  Wiring wired = Wiring::series;

  bool parallel() const { return wired == Wiring::parallel; }
  /// Of the bundle's resistance: by how much it rises when one of parallel threads breaks, or falls
  /// when one of those in series is shorted.
  double one_lost_ratio() const { return parallel() ? 1.0 / (muscles - 1) : 1.0 / muscles; }
  /// What each of the others gets then, over what is taken for its share.
  double others_power_ratio() const { return static_cast<double>(muscles) / (muscles - 1); }
  /// Of such a change, the most that resistance_drift lets pass: a muscle that is cold may by its
  /// bounds be as hot as the limit, and a hot one cold.
  double unseen_ratio(const ChannelSettings& channel) const;
};

}  // namespace supercoil::config
