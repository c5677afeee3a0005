// The parameters with which the MRAC's closed loop equals its reference model.
#pragma once

#include <optional>

#include "supercoil/control/tracking/law_definition.hpp"
#include "supercoil/control/tracking/mrac_settings.hpp"

namespace supercoil::control {

/// The solution θ* of the matching equation, and the compensator λ − θ1ᵀα that it implies.
struct MracMatching {
  MracSettings::Parameters theta;  ///< for position in watts at rest, when the plant is normalised
  Polynomial<2> compensator;       ///< λ(s) − θ1ᵀα(s): what u is divided by
  bool compensator_stable;
};

/// (λ − θ1ᵀα)R − b3(θ2ᵀα + θ3 λ) = λ Rm, c0 = k/b3, solved for θ by comparing powers of s.
/// plant: x/P in the law's units; for signals in watts at rest give b3 = b0.
/// Empty when a coefficient of α is zero or b3 is not positive.
std::optional<MracMatching> match(const TransferFunction& plant, const MracSettings& settings,
                                  const ReferenceModelSettings& model);

/// The law with the feedback of θ* added. Empty when no θ matches.
std::optional<FixedLaw> add_matched(FixedLaw law, const MracSettings& filters,
                                    const LawContext& context, const PhysicalParameters& muscle);

}  // namespace supercoil::control
