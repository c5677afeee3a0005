#include "runner/reference_feasibility.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/reference_model.hpp"

#include "text/number_text.hpp"

namespace supercoil::host_sim {

namespace {

constexpr double max_step_s = 5e-3;
constexpr double steps_per_period = 100.0;
/// Of a reference that is longer, the rest is not looked at: a tenth of a second is enough to wait.
constexpr std::int64_t max_steps = 2'000'000;
constexpr double max_slowing = 100.0;
constexpr int digits = 3;  ///< these are predictions

bool is_periodic(const Reference& reference) {
  return reference.kind == ReferenceKind::sine || reference.kind == ReferenceKind::multisine;
}

double step_s(const Reference& reference) {
  double fastest = 0.0;
  for (const Sinusoid& term : reference.terms)
    fastest = std::fmax(fastest, std::abs(term.angular_frequency_rad_per_s));
  return std::fmin(max_step_s, 2.0 * std::numbers::pi / (steps_per_period * fastest));
}

/// What the muscle needs for a motion of the model by 1 m in the reference, at this frequency.
double power_W_per_m(const Conditions& c, double angular_frequency_rad_per_s) {
  const std::complex<double> s{0.0, angular_frequency_rad_per_s};
  const control::Polynomial<3>& a = c.controller.model.denominator;
  const control::Theta theta = control::theta_from(c.muscle);
  const auto model = c.controller.model.gain / (((s + a[2]) * s + a[1]) * s + a[0]);
  const auto muscle = ((theta[0] * c.muscle.moving_mass_kg * s + theta[1]) * s + theta[2]) * s +
                      std::complex<double>(theta[3]);
  return std::abs(model * muscle);
}

/// Of sines that have gone on for long, about what their middle needs. Several may be at their
/// peaks at once.
double power_amplitude_W(const Conditions& c, double slowing = 1.0) {
  double amplitude_W = 0.0;
  for (const auto& [amplitude_m, angular_frequency_rad_per_s] : c.reference.terms) {
    amplitude_W += std::abs(amplitude_m) * power_W_per_m(c, angular_frequency_rad_per_s / slowing);
  }
  return amplitude_W;
}

/// How far the power may go to both sides of what the middle needs; below 0: not even that.
double room_W(const Conditions& c) {
  const double middle_W = c.reference.offset / c.muscle.dc_gain_m_per_W();
  return std::fmin(middle_W - c.power.min_W, c.power.max_W - middle_W);
}

double feasible_slowing(const Conditions& c) {
  const auto fits = [&](double slowing) { return power_amplitude_W(c, slowing) <= room_W(c); };
  if (!fits(max_slowing)) return INFINITY;
  double too_fast = 1.0;
  double slow = max_slowing;
  while (slow > 1.01 * too_fast) {
    const double middle = std::sqrt(too_fast * slow);
    (fits(middle) ? slow : too_fast) = middle;
  }
  return slow;
}

/// Tells how much of the time, and when first.
void find_infeasible(const Conditions& c, double duration_s, ReferenceFeasibility& f) {
  const double step = step_s(c.reference);
  const auto steps = std::clamp<std::int64_t>(std::llround(duration_s / step), 1, max_steps);
  const control::ReferenceShaper inverse(
      c.controller.model, {control::theta_from(c.muscle), {}, c.muscle.moving_mass_kg});
  control::ReferenceModel<double> model(c.controller.model, step);
  std::int64_t infeasible = 0;
  for (std::int64_t i = 0; i < steps; ++i) {
    const double time_s = static_cast<double>(i) * step;
    const double reference_m = c.reference.at(time_s);
    const double power_W = inverse.power_W(reference_m, model.motion());
    model.step(reference_m);
    if (power_W >= c.power.min_W && power_W <= c.power.max_W) continue;
    if (infeasible++ > 0) continue;
    f.first_s = time_s;
    f.first = power_W < c.power.min_W ? control::Infeasible::cooling : control::Infeasible::heating;
  }
  f.infeasible_ratio = static_cast<double>(infeasible) / static_cast<double>(steps);
}

}  // namespace

std::optional<ReferenceFeasibility> reference_feasibility(const Scenario& scenario) {
  const Conditions& c = scenario.start;
  const bool follows = c.action == OperatorAction::track &&
                       c.controller.kind != control::ControllerKind::power &&
                       c.antagonist() == nullptr;
  if (!follows) return std::nullopt;
  ReferenceFeasibility f;
  // An event may change all of it.
  const double end_s = scenario.events.empty() ? scenario.duration_s : scenario.events[0].at_s;
  find_infeasible(c, end_s, f);
  if (is_periodic(c.reference) && f.infeasible_ratio > told_infeasible_ratio) {
    f.feasible_motion_ratio = std::clamp(room_W(c) / power_amplitude_W(c), 0.0, 1.0);
    if (f.feasible_motion_ratio < 1.0) f.feasible_slowing = feasible_slowing(c);
  }
  return f;
}

std::string describe_reference(const Scenario& scenario, bool in_brief) {
  const auto f = reference_feasibility(scenario);
  if (!f) return {};
  if (f->infeasible_ratio <= told_infeasible_ratio)
    return in_brief ? "" : "asks for no more than the muscle can do";
  std::string line =
      "asks for more than the muscle can do for " +
      number_text(100.0 * f->infeasible_ratio, digits) + " % of the time, first at " +
      number_text(f->first_s, digits) + " s, when it would have to be " +
      (f->first == control::Infeasible::cooling
           ? "cooled"
           : "heated with more than " + number_text(scenario.start.power.max_W, digits) + " W");
  if (f->feasible_motion_ratio == 0.0) return line + "; not even its middle can be held";
  if (f->feasible_motion_ratio < 1.0) {
    line += "; " + number_text(f->feasible_motion_ratio, digits) +
            " of its motion about the middle is feasible";
    if (std::isfinite(f->feasible_slowing))
      line += ", or all of it " + number_text(f->feasible_slowing, digits) + " times as slow";
  }
  return line + (scenario.start.controller.shape_reference
                     ? "; it is shaped, so that the muscle follows it as it can"
                     : "; with shape_reference = true the muscle follows it as it can");
}

std::string describe_unseen_rest(const Scenario& scenario) {
  const Conditions& c = scenario.start;
  const double rest_m = -c.plant.load_N / c.plant.parameters.stiffness_N_per_m;
  const double min_m = c.position_sensor.min_m;
  if (c.joint || rest_m >= min_m) return {};
  return "plant.load_N holds the muscle at " + number_text(1e3 * rest_m, digits) +
         " mm while it is cold, and the sensor reads no less than " +
         number_text(1e3 * min_m, digits) +
         " mm: it stands still there and looks frozen (docs/faults/sensor_frozen.md); lower "
         "sensor.position.min_m";
}

}  // namespace supercoil::host_sim
