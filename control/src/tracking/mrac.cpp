#include "supercoil/control/tracking/mrac.hpp"

#include <algorithm>
#include <cmath>

#include "supercoil/control/tracking/mrac_matching.hpp"
#include "supercoil/control/tracking/mrac_premises.hpp"

namespace supercoil::control {

MracSettings MracSettings::scaled(double factor) const {
  MracSettings result = *this;
  result.adaptation_scale *= factor;
  return result;
}

std::optional<MracSettings> mrac_preset(std::string_view name, double max_W) {
  if (name == "printed") return MracSettings{};
  if (name == "a") {
    MracSettings a;
    // θ̇ = Π φ ε: both φ and ε are in watts, so Π counts squared watts.
    const double rate = 20.0 * (paper_max_W / max_W) * (paper_max_W / max_W);
    a.gain *= rate;
    a.sigma_gain *= rate;
    a.alpha = {20.0, 400.0};
    a.lambda = {400.0, 40.0, 1.0};
    a.damping = 1.0;
    a.initial[5] = 0.3;
    return a;
  }
  return std::nullopt;
}

std::optional<FixedLaw> MracLaw::fixed_law(const Settings& s, const LawContext& context,
                                           const PhysicalParameters& muscle) {
  return add_matched({}, s, context, muscle);
}

void MracLaw::add_contradictions(LawProblems& problems, const Settings& s,
                                 const LawContext& context) {
  if (s.accept_failed_premises) return;
  for (const char* failure : check_premises(s, context.model).failures()) {
    if (failure != nullptr) problems.add({"kind", failure, true});
  }
}

void MracLaw::check_fit(FixedPointFit& fit, const Settings& s, const LawContext&, double step_s,
                        double peak_W) {
  constexpr double signal = FixedPointFit::signal;
  constexpr double state = FixedPointFit::state;
  fit.at_most("lambda", std::max(std::abs(s.lambda[0]), std::abs(s.lambda[1])), state);
  fit.at_most("alpha", std::max(s.alpha[0], s.alpha[1]), state);
  // The largest values for a signal of peak_W: of ω2 at rest, and of ω1 at the filter's middle.
  fit.at_most("alpha", peak_W * std::abs(s.alpha[1] / s.lambda[0]), signal);
  fit.at_most("alpha", peak_W * std::abs(s.alpha[0] / s.lambda[1]), signal);
  for (const double gain : s.scaled_gain())
    fit.gain("gain", gain * step_s);
  for (const double value : s.initial)
    fit.at_most("initial", value, signal);
  fit.at_most("sigma_gain", s.scaled_sigma_gain(), state);
  fit.at_most("initial_sigma", s.initial_sigma, state);
  fit.at_most("damping", s.damping, state);
  if (!s.bounds) return;
  // θ is used with 8 integer bits: bounds beyond those would have no effect.
  for (const double value : s.bounds->lower)
    fit.at_most("lower", std::max(value, -signal), signal);
  for (const double value : s.bounds->upper)
    fit.at_most("upper", std::min(value, signal), signal);
}

}  // namespace supercoil::control
