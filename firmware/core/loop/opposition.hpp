// What the other muscle of a joint does, as the axis of this one sees it.
#pragma once

#include "supercoil/control/tracking/law.hpp"

#include "supervisor/detectors/heater.hpp"

namespace supercoil {

/// Of a muscle without another all is zero.
struct Opposition {
  double power_W = 0.0;  ///< that acts, in watts of this muscle: by so much it moves the joint less
  bool limited = false;  ///< that is not what was wanted
  control::PowerRange range{0.0, 0.0};  ///< of power_W
  /// By how much its heat moves the joint against this muscle, as HeaterInputs::expected_m.
  detectors::NotResponding::Expected expected_m{};
  double hottest_K = 0.0;  ///< above the air
};

}  // namespace supercoil
