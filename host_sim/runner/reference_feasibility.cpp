#include "runner/reference_feasibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/reference_shaper.hpp"

#include "config/recommended_controller.hpp"
#include "loop/feasibility.hpp"
#include "runner/available_power.hpp"
#include "runner/board_of.hpp"
#include "runner/reference_demand.hpp"

namespace supercoil::host_sim {

namespace {

constexpr double max_step_s = 5e-3;
constexpr double steps_per_period = 100.0;
/// The rest of a longer reference is ignored: a tenth of a second is enough to wait.
constexpr std::int64_t max_steps = 2'000'000;
constexpr double max_slowing = 100.0;

bool is_periodic(const Reference& reference) {
  return reference.kind == ReferenceKind::sine || reference.kind == ReferenceKind::multisine;
}

double step_s(const Reference& reference) {
  double fastest = 0.0;
  for (const Sinusoid& term : reference.terms)
    fastest = std::fmax(fastest, std::abs(term.angular_frequency_rad_per_s));
  return std::fmin(max_step_s, 2.0 * std::numbers::pi / (steps_per_period * fastest));
}

/// Frequency response of a model.
std::complex<double> response(const control::ReferenceModelSettings& model,
                              double angular_frequency_rad_per_s) {
  const std::complex<double> s{0.0, angular_frequency_rad_per_s};
  const control::Polynomial<3>& a = model.denominator;
  return model.gain / (((s + a[2]) * s + a[1]) * s + a[0]);
}

double passed_ratio(const control::ReferenceModelSettings& model, const Reference& reference) {
  double demanded_m = 0.0;
  double passed_m = 0.0;
  for (const auto& [amplitude_m, angular_frequency_rad_per_s] : reference.terms) {
    demanded_m += std::abs(amplitude_m);
    passed_m += std::abs(amplitude_m) * std::abs(response(model, angular_frequency_rad_per_s));
  }
  return demanded_m > 0.0 ? passed_m / demanded_m : 1.0;
}

double off_reference_rms_m(const control::ReferenceModelSettings& model,
                           const Reference& reference) {
  double square_m2 = 0.0;
  for (const auto& [amplitude_m, angular_frequency_rad_per_s] : reference.terms) {
    square_m2 +=
        0.5 * std::norm(amplitude_m * (1.0 - response(model, angular_frequency_rad_per_s)));
  }
  return std::sqrt(square_m2);
}

/// Power amplitude for 1 m of reference amplitude through the model, at this frequency.
double power_W_per_m(const Conditions& c, double angular_frequency_rad_per_s) {
  const std::complex<double> s{0.0, angular_frequency_rad_per_s};
  const control::Theta theta = control::theta_from(c.muscle);
  const auto model = response(c.controller.model, angular_frequency_rad_per_s);
  const auto muscle = ((theta[0] * c.muscle.moving_mass_kg * s + theta[1]) * s + theta[2]) * s +
                      std::complex<double>(theta[3]);
  return std::abs(model * muscle);
}

/// Power amplitude of settled sines, about what their middle needs. Several sines may peak at once.
double power_amplitude_W(const Conditions& c, double slowing = 1.0) {
  double amplitude_W = 0.0;
  for (const auto& [amplitude_m, angular_frequency_rad_per_s] : c.reference.terms) {
    amplitude_W += std::abs(amplitude_m) * power_W_per_m(c, angular_frequency_rad_per_s / slowing);
  }
  return amplitude_W;
}

/// How far the power may swing about what the middle needs; below 0: not even that.
double room_W(const Conditions& c, double max_W) {
  const double middle_m = c.reference.offset + c.plant.load_N / c.muscle.stiffness_N_per_m;
  const double middle_W = middle_m / c.muscle.dc_gain_m_per_W();
  return std::fmin(middle_W - c.power.min_W, max_W - middle_W);
}

double feasible_slowing(const Conditions& c, double max_W) {
  const auto fits = [&](double slowing) {
    return power_amplitude_W(c, slowing) <= room_W(c, max_W);
  };
  if (!fits(max_slowing)) return INFINITY;
  double too_fast = 1.0;
  double slow = max_slowing;
  while (slow > 1.01 * too_fast) {
    const double middle = std::sqrt(too_fast * slow);
    (fits(middle) ? slow : too_fast) = middle;
  }
  return slow;
}

/// For sines: finds the motion that would be feasible instead.
void find_feasible_motion(const Conditions& c, double max_W, ReferenceFeasibility& f) {
  f.feasible_motion_ratio = room_W(c, max_W) / power_amplitude_W(c);
  double amplitude_m = 0.0;
  for (const Sinusoid& term : c.reference.terms)
    amplitude_m += std::abs(term.amplitude);
  const double held_ratio = (f.held_m - c.reference.offset) / amplitude_m;
  // However slow the motion is, the muscle stays there for long.
  const bool too_far = is_thermal(f.limited_by) && held_ratio < 1.0;
  if (too_far) f.feasible_motion_ratio = std::fmin(f.feasible_motion_ratio, held_ratio);
  f.feasible_motion_ratio = std::clamp(f.feasible_motion_ratio, 0.0, 1.0);
  if (f.feasible_motion_ratio < 1.0)
    f.feasible_slowing = too_far ? INFINITY : feasible_slowing(c, max_W);
}

/// Finds when, for how long and by how much it asks too much, how far it leads, and how it ends.
void find_infeasible(const Conditions& c, double duration_s, double step,
                     const AvailablePower& available, double saturated_s, ReferenceFeasibility& f) {
  const auto steps = std::clamp<std::int64_t>(std::llround(duration_s / step), 1, max_steps);
  ReferenceDemand demand(c, c.muscle, c.plant.load_N, available, step);
  InfeasibleTime found;
  std::array<double, limit_names.size()> excess_W{};
  double met_s = 0.0;  ///< from then on it lacks power
  for (std::int64_t i = 0; i < steps; ++i) {
    const double time_s = static_cast<double>(i) * step;
    const auto [by, by_W, unmet] = demand.step(c.reference.at(time_s));
    f.max_m = std::fmax(f.max_m, demand.demanded_m());
    f.behind_m = std::fmax(f.behind_m, std::abs(demand.behind_m()));
    found.add(by, time_s);
    double& excess = excess_W.at(static_cast<std::size_t>(by));
    excess = std::fmax(excess, by_W);
    if (!unmet) met_s = time_s + step;
    if (std::isnan(f.invalid_s) && time_s - met_s >= saturated_s) f.invalid_s = time_s;
  }
  f.max_m = std::fmin(f.max_m, c.reference.max());  // a model may swing beyond
  f.infeasible_ratio = found.ratio();
  if (!found.found()) return;
  f.first_s = found.first_s();
  f.first_duration_s = found.first_duration_s() + step;
  f.first_ends = found.first_ended();
  f.limited_by = found.main_limit();
  f.excess_W = excess_W.at(static_cast<std::size_t>(f.limited_by));
}

}  // namespace

bool follows_position(const Conditions& c) {
  return c.action == OperatorAction::track && c.controller.kind != control::ControllerKind::power &&
         c.antagonist() == nullptr;
}

std::optional<ReferenceFeasibility> reference_feasibility(const Scenario& scenario) {
  const Conditions& c = scenario.start;
  if (!follows_position(c)) return std::nullopt;
  const BoardSettings board = forecast_board_of(scenario);
  const ChannelSettings& channel = board.channels[0];
  const Feasibility muscle = feasibility(channel, board);
  ReferenceFeasibility f;
  f.held_m = muscle.held_W * channel.muscle.dc_gain_m_per_W() - load_m(channel);
  f.held_by = muscle.held_by;
  f.once_identified = muscle.held_by == LimitedBy::unproven && !channel.muscle_identified;
  if (is_periodic(c.reference)) {
    const auto recommended = config::recommended_controller(channel, board);
    f.passed_ratio = passed_ratio(c.controller.model, c.reference);
    f.off_reference_rms_m = off_reference_rms_m(c.controller.model, c.reference);
    f.passed_by_recommended_ratio =
        passed_ratio(recommended.applied_to(c.controller).model, c.reference);
  }
  const double step = step_s(c.reference);
  const AvailablePower available(board, c.power.supply_V, step);
  // An event may change all of it.
  const double end_s = scenario.events.empty() ? scenario.duration_s : scenario.events[0].at_s;
  find_infeasible(c, end_s, step, available, channel.supervision.saturated_s, f);
  if (is_periodic(c.reference) && !f.feasible())
    find_feasible_motion(c, available.cold().power_W, f);
  return f;
}

}  // namespace supercoil::host_sim
