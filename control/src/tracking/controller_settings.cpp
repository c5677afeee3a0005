#include "supercoil/control/tracking/controller_settings.hpp"

#include <algorithm>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::control {

namespace {

LawContext context_of(const ControllerSettings& s) {
  return {s.model, s.dc_gain_m_per_W};
}

}  // namespace

void ControllerSettings::set_nominal(const PhysicalParameters& muscle, double max_W) {
  dc_gain_m_per_W = muscle.dc_gain_m_per_W();
  shaped_for = {theta_from(muscle), dc_gain_m_per_W, muscle.moving_mass_kg};
  with_each<Laws>(*this,
                  [&](auto law, auto& own) { decltype(law)::set_nominal(own, shaped_for, max_W); });
}

std::optional<FixedLaw> fixed_law(const ControllerSettings& s, const PhysicalParameters& muscle) {
  std::optional<FixedLaw> fixed;
  with_chosen<Laws>(s, [&](auto law, const auto& own) {
    fixed = decltype(law)::fixed_law(own, context_of(s), muscle);
  });
  return fixed;
}

LawProblems contradictions_of_law(const ControllerSettings& s) {
  LawProblems problems;
  with_chosen<Laws>(s, [&](auto law, const auto& own) {
    decltype(law)::add_contradictions(problems, own, context_of(s));
  });
  return problems;
}

std::optional<Violation> check_fit(const ControllerSettings& s, double step_s,
                                   double max_reference_m, double max_W) {
  if (s.arithmetic != Arithmetic::q8_24) return std::nullopt;
  FixedPointFit fit;
  with_chosen<Laws>(s, [&](auto law, const auto& own) {
    const double reference_W = max_reference_m / s.dc_gain_m_per_W;
    fit.at_most("arithmetic", reference_W, FixedPointFit::signal);
    fit.at_most("arithmetic", max_W, FixedPointFit::signal);
    for (const double coefficient : s.model.denominator)
      fit.at_most("arithmetic", coefficient, FixedPointFit::state);
    if constexpr (decltype(law)::fixed_point)
      decltype(law)::check_fit(fit, own, context_of(s), step_s, std::max(reference_W, max_W));
  });
  return fit.violation();
}

}  // namespace supercoil::control
