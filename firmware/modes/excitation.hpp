// The power that teaches most about a muscle.
#pragma once

#include <cmath>

namespace supercoil::modes {

/// P = 2.2 + 0.5(sin 0.3t + sin 1.1t + sin 3.1t) + 0.6 sin 9t, for 4.5 W at most: it divides the
/// condition number of the paper's Eq. (18) by 4.5 (docs/paper.md). Scaled to a channel's own
/// greatest power; its lowest is 0.02 and its highest 0.96 of it.
inline double excitation_W(double time_s, double max_W) {
  const double power_W =
      2.2 + 0.5 * (std::sin(0.3 * time_s) + std::sin(1.1 * time_s) + std::sin(3.1 * time_s)) +
      0.6 * std::sin(9.0 * time_s);
  return power_W * max_W / 4.5;
}

}  // namespace supercoil::modes
