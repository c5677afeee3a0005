#include "loop/feasibility.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/reference_shaper.hpp"

#include "board/known_heat.hpp"
#include "loop/hanging_arm.hpp"

namespace supercoil {

namespace {

/// The steady power at which derating allows just that power: the hottest that the muscle may be
/// rises with it, and the limiter falls from max_W at derate_from_C to 0 at derate_to_C.
double derated_W(const ChannelSettings& c, const BoardSettings& board, double max_W,
                 double warmest_C) {
  const LimiterSettings& l = c.limiter;
  const double ratio = power_bounds(c, board).true_over_measured().max;
  const double eta = board::known_thermal_bounds(c.thermal, c.heat).bounds.min_transfer_W_per_K;
  if (warmest_C + max_W * ratio / eta <= l.derate_from_C) return max_W;
  const double crossing_W = l.max_W * (l.derate_to_C - warmest_C) /
                            (l.derate_to_C - l.derate_from_C + l.max_W * ratio / eta);
  return std::clamp(crossing_W, 0.0, max_W);
}

struct Held {
  double power_W = 0.0;
  LimitedBy by = LimitedBy::maximum;
};

/// In air that is known to be no warmer than warmest_C.
Held held_in(const ChannelSettings& c, const BoardSettings& board, double max_W, double warmest_C) {
  Held held{max_W};
  const auto bound = [&](double power_W, LimitedBy by) {
    if (power_W < held.power_W) held = {power_W, by};
  };
  bound(derated_W(c, board, max_W, warmest_C), LimitedBy::temperature);
  // Colder air does not help the proof.
  if (c.supervision.proof_of_response) {
    bound(plan_proof(proof_settings(c, board), c.muscle, board.rate_Hz).provable_W,
          LimitedBy::unproven);
  }
  return held;
}

void find_power(const ChannelSettings& c, const BoardSettings& board, Feasibility& f) {
  const double supply_V = board.supervision.min_supply_V;
  f.max_W = std::min(c.limiter.max_W, supply_V * supply_V / c.heater.cold_resistance_Ohm);
  const Held held = held_in(c, board, f.max_W, c.thermal.air.warmest_C);
  f.held_W = held.power_W;
  f.held_by = held.by;
}

/// How far this power holds the muscle indefinitely.
double held_travel_m(const ChannelSettings& c, double power_W) {
  const double max_m = c.supervision.max_travel_m;
  if (c.joint.weighs()) return HangingArm(c.joint, c.muscle).held_m(power_W, max_m);
  return std::clamp(c.muscle.dc_gain_m_per_W() * power_W - load_m(c), 0.0, max_m);
}

double holding_power_W(const ChannelSettings& c, double position_m) {
  if (c.joint.weighs()) return HangingArm(c.joint, c.muscle).power_W(position_m);
  return (position_m + load_m(c)) / c.muscle.dc_gain_m_per_W();
}

/// Heat alone determines rise and fall: the spring and the load follow it.
void find_motion(const ChannelSettings& c, Feasibility& f) {
  const double tau_s = -1.0 / c.muscle.thermal_pole_rad_per_s();
  f.travel_m = held_travel_m(c, f.held_W);
  // As fractions of max_W: the power for the load, and from there to the top.
  const double load_ratio = load_m(c) / c.muscle.dc_gain_m_per_W() / f.max_W;
  const double travel_ratio = holding_power_W(c, f.travel_m) / f.max_W - load_ratio;
  f.rise_s = tau_s * std::log((1.0 - load_ratio - 0.1 * travel_ratio) /
                              (1.0 - load_ratio - 0.9 * travel_ratio));
  f.fall_s = tau_s * std::log(9.0);
  // P = (x + τẋ)/gain must not fall below 0: an amplitude of half the mean gives (ωτ)² = 3. The
  // room below max_W is at least as large.
  f.half_travel_period_s = 2.0 * std::numbers::pi * tau_s / std::numbers::sqrt3;
  if (load_ratio == 0.0 || travel_ratio == 0.0) return;
  // A load takes power at rest, which leaves more to fall with and less to rise with. A load that
  // lifts may keep the muscle from falling that far.
  const double low_ratio = load_ratio + 0.1 * travel_ratio;
  f.fall_s =
      low_ratio > 0.0 ? tau_s * std::log((load_ratio + 0.9 * travel_ratio) / low_ratio) : INFINITY;
  const double middle = load_ratio + 0.5 * travel_ratio;
  const double room = std::min(middle, 1.0 - middle) / (0.25 * travel_ratio);
  f.half_travel_period_s =
      room > 1.0 ? 2.0 * std::numbers::pi * tau_s / std::sqrt(room * room - 1.0) : INFINITY;
}

/// The coldest air lowers the muscle, but allows it more power if a sensor measures the air.
double cold_travel_m(const ChannelSettings& c, const BoardSettings& board, const Feasibility& f) {
  const board::AirSettings& air = c.thermal.air;
  double warmest_C = air.warmest_C;
  if (air.error_K > 0.0) warmest_C = std::min(warmest_C, air.coldest_C + 2.0 * air.error_K);
  const double air_W = f.air_shift_m / c.muscle.dc_gain_m_per_W();
  return std::max(0.0, held_travel_m(c, held_in(c, board, f.max_W, warmest_C).power_W - air_W));
}

void find_rest(const ChannelSettings& c, const BoardSettings& board, Feasibility& f) {
  const board::ThermalSettings& t = c.thermal;
  // A joint's other muscle is in the same air and turns it back by about as much.
  f.air_shift_m = c.joint.has_other() ? 0.0 : air_shift_m(c);
  f.cold_travel_m = cold_travel_m(c, board, f);
  // The sensor's range refers to its reading before calibration.
  const double rest_m =
      c.calibration.position_offset_m - f.air_shift_m / c.calibration.position_scale;
  f.rest_seen = rest_m >= c.supervision.min_position_m;
  const control::ThermalBounds b = board::known_thermal_bounds(t, c.heat).bounds;
  const double allowed_K = c.limiter.derate_from_C - t.air.warmest_C;
  f.armable_s =
      allowed_K <= 0.0
          ? INFINITY
          : std::max(0.0, control::max_time_constant_s(b) * std::log(t.boot_rise_K / allowed_K));
}

std::optional<FeasibleSteps> feasible_steps(const control::ControllerSettings& controller,
                                            const ChannelSettings& c, const Feasibility& f) {
  if (controller.kind == control::ControllerKind::power) return std::nullopt;
  const double peak = peak_W_per_m(controller.model, c.muscle);
  const double load_W = load_m(c) / c.muscle.dc_gain_m_per_W();
  const double down_m =
      std::min(f.travel_m, (f.travel_m / c.muscle.dc_gain_m_per_W() + load_W) / peak);
  return FeasibleSteps{std::clamp((f.max_W - load_W) / peak, 0.0, f.travel_m),
                       c.joint.has_other() ? NAN : down_m, controller.shape_reference};
}

}  // namespace

Feasibility feasibility(const ChannelSettings& channel, const BoardSettings& board) {
  Feasibility f;
  find_power(channel, board, f);
  find_motion(channel, f);
  find_rest(channel, board, f);
  for (const control::ControllerSettings& controller : channel.controllers)
    f.steps.push_back(feasible_steps(controller, channel, f));
  return f;
}

double air_shift_m(const ChannelSettings& channel) {
  const control::PhysicalParameters& muscle = channel.muscle;
  const board::AirSettings& air = channel.thermal.air;
  return muscle.force_per_kelvin_N_per_K / muscle.stiffness_N_per_m *
         (air.warmest_C - air.coldest_C);
}

double peak_W_per_m(const control::ReferenceModelSettings& settings,
                    const control::PhysicalParameters& muscle) {
  // The peak comes within the first time constants of the model's fastest pole.
  constexpr int steps = 2000;
  const double step_s = 20.0 / (steps * std::cbrt(settings.denominator[0]));
  const control::RegressionScale scale{control::theta_from(muscle), {}, muscle.moving_mass_kg};
  const control::ReferenceShaper inverse(settings, scale);
  control::ReferenceModel<double> model(settings, step_s);
  double peak_W = 0.0;
  for (int i = 0; i < steps; ++i) {
    peak_W = std::max(peak_W, inverse.power_W(1.0, model.motion()));
    model.step(1.0);
  }
  return peak_W;
}

double hottest_pull_N(const ChannelSettings& channel, double power_W) {
  const double rise_K = power_W / channel.thermal.bounds.min_transfer_W_per_K;
  const double allowed_K = channel.supervision.trip_C - channel.thermal.air.coldest_C;
  return std::min(rise_K, allowed_K) * channel.muscle.force_per_kelvin_N_per_K;
}

}  // namespace supercoil
