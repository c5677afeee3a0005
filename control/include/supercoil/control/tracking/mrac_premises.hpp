// What the stability proof of the MRAC assumes, checked before it may run.
#pragma once

#include <array>
#include <cstddef>

#include "supercoil/control/tracking/mrac_settings.hpp"
#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::control {

/// Which premises of Ioannou & Fidan 2006, Sec. 5.3, hold.
struct MracPremises {
  bool lambda_hurwitz;        ///< λ(s) is Hurwitz
  bool poles_positive;        ///< p0, p1, q0 > 0
  bool gains_positive;        ///< every diagonal element of Π > 0, ν >= 0, α0 >= 0
  bool model_hurwitz;         ///< the reference model is stable
  PositiveRealness realness;  ///< of Wm(s)(s + p0)(s + p1)
  bool model_factors;         ///< Wm(s)(s + p0)(s + p1) = k/(s + q0), which Eq. (12) needs

  bool hold() const {
    return lambda_hurwitz && poles_positive && gains_positive && model_hurwitz &&
           realness.strict() && model_factors;
  }

  static constexpr std::size_t count = 6;
  /// The failing premises in words, in the order above; null where one holds.
  std::array<const char*, count> failures() const;
};

/// Takes any settings; values that are not finite fail.
MracPremises check_premises(const MracSettings& settings, const ReferenceModelSettings& model);

}  // namespace supercoil::control
