#include "loop/promise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modes/identify.hpp"

namespace supercoil {

namespace {

/// Of the travel. A muscle that is not linear takes up to twice the power where it is hot, and no
/// more is held: this leaves room for it, and the power stays clear of 0 as well.
constexpr double middle_ratio = 0.4;
constexpr double amplitude_ratio = 0.16;
constexpr double slower_than_fastest = 1.2;
/// Of a muscle that only shorter strokes found, these strokes tell nothing of the upper travel.
constexpr double short_strokes_ratio = 0.7;
/// Quicker ones show nothing that this does not, and a person sees it.
constexpr double min_period_s = 5.0;
/// Slower ones only take time: a smaller sine shows a slow muscle in this one.
constexpr double max_period_s = 36.0;

/// One period's error differs from the next one's, and motion from that of identify: of 200 muscles
/// (tests/setup/setup_study.cpp, 1 to 200) 97 % stay below.
constexpr double allowance = 1.8;
/// White noise of each tick through a loop of this bandwidth, and what its damping adds.
constexpr double noise_gain = 2.5;
/// Motion that is quicker than a drift, over the sensor's noise, which needs no dither.
constexpr double telling_deviations = 20.0;
/// Below, expect ringing (docs/control.md).
constexpr double ringing_margin = 0.3;
/// As dither_for has it.
constexpr double max_dither_m = 20e-6;
/// What the linear model leaves unexplained where identify has not told it yet: four of five random
/// muscles (tests/setup/setup_study.cpp, 1001 to 1200) leave less.
constexpr double usual_unexplained_ratio = 0.015;

/// What a muscle makes of power that is rounded to the PWM's steps. With error feedback the next
/// tick gives back what one took; without it a rounding lasts until the controller notices.
double pwm_ripple_m(const ChannelSettings& channel, const BoardSettings& board,
                    double bandwidth_rad_per_s) {
  const HeaterSettings& heater = channel.heater;
  const double supply_V = board.supervision.max_supply_V;
  const double step_W = supply_V * supply_V / heater.cold_resistance_Ohm / heater.pwm_steps;
  const double lasts_s = heater.error_feedback ? board.step_s() : 1.0 / bandwidth_rad_per_s;
  const double tau_s = -1.0 / channel.muscle.thermal_pole_rad_per_s();
  return channel.muscle.dc_gain_m_per_W() * step_W / std::sqrt(12.0) *
         std::min(1.0, lasts_s / tau_s);
}

/// Of a muscle that was stored before this was, it may be as much as identify lets pass.
double unexplained_ratio(const ChannelSettings& channel) {
  if (channel.unexplained_ratio > 0.0) return channel.unexplained_ratio;
  if (channel.simulated.linear) return 0.0;
  return channel.muscle_identified ? modes::Identify::Settings{}.max_unexplained
                                   : usual_unexplained_ratio;
}

/// Over that of the widest sine: as much power swings, P = (x + τẋ)/gain, if it is quicker.
double amplitude_at(double period_s, double widest_period_s) {
  // slower_than_fastest times 2πτ/√3, of which f.half_travel_period_s is made.
  const double widest = std::numbers::sqrt3 / slower_than_fastest;
  const double quicker = widest * std::fmax(1.0, widest_period_s / period_s);
  return std::hypot(1.0, widest) / std::hypot(1.0, quicker);
}

}  // namespace

double FirstMotion::at(double time_s) const {
  // Up along the sine's own rise: no step at the beginning.
  const double angle = 2.0 * std::numbers::pi * time_s / period_s;
  return middle_m - amplitude_m * std::cos(angle);
}

FirstMotion plan_first_motion(const Feasibility& f, double unexplained_ratio) {
  const bool short_strokes = unexplained_ratio > modes::Identify::Settings{}.max_unexplained;
  const double shown_m = (short_strokes ? short_strokes_ratio : 1.0) * f.travel_m;
  const double widest_period_s = slower_than_fastest * f.half_travel_period_s;
  const double period_s = std::clamp(widest_period_s, min_period_s, max_period_s);
  return {middle_ratio * shown_m,
          amplitude_ratio * shown_m * amplitude_at(period_s, widest_period_s), period_s};
}

bool is_promised_for(const control::ControllerSettings& controller, const ChannelSettings& channel,
                     double step_s) {
  if (controller.kind != control::ControllerKind::learned_ff) return false;
  const auto margin = margin_of(controller, channel, step_s);
  return margin && margin->stable() && margin->modulus >= ringing_margin;
}

double reading_noise_m(const ChannelSettings& channel) {
  return std::hypot(channel.supervision.position_noise_rms_m,
                    channel.position.scaling.per_count / std::sqrt(12.0));
}

double Promise::error_m() const {
  return allowance * std::hypot(std::hypot(noise_m, probe_m, pwm_m), std::hypot(dither_m, delay_m),
                                unexplained_m);
}

Promise promise_error(const control::LearnedFeedforwardSettings& law,
                      const ChannelSettings& channel, const BoardSettings& board,
                      const FirstMotion& motion) {
  Promise p;
  const control::PhysicalParameters& m = channel.muscle;
  const double bandwidth = law.bandwidth_rad_per_s;
  const double count_m = channel.position.scaling.per_count;
  const double reading_m = reading_noise_m(channel);
  p.noise_m = reading_m * std::hypot(1.0, noise_gain * std::sqrt(0.5 * bandwidth * board.step_s()));

  const double tau_s = -1.0 / m.thermal_pole_rad_per_s();
  const double turn = 2.0 * std::numbers::pi / motion.period_s;
  const double gain = m.dc_gain_m_per_W();
  const double middle_W = (motion.middle_m + load_m(channel)) / gain;
  const double amplitude_W = motion.amplitude_m * std::hypot(1.0, turn * tau_s) / gain;
  const double supply_V = board.supervision.max_supply_V;
  const double probe_W =
      channel.heater.probe_duty * supply_V * supply_V / channel.heater.cold_resistance_Ohm;
  const double below = std::clamp((middle_W - probe_W) / amplitude_W, -1.0, 1.0);
  const double below_s = motion.period_s / std::numbers::pi * std::acos(below);
  // Heat through which the resistance is measured comes again before that is old.
  if (below_s > channel.heater.probe_every_s)
    p.probe_m = gain * probe_W * std::min(1.0, channel.heater.probe_s / tau_s);

  // Where the motion itself tells too little, a dither asks whether the muscle still answers.
  const double quick_m = motion.amplitude_m * turn / std::hypot(turn, motion_corner_rad_per_s);
  if (channel.supervision.proof_of_response && quick_m < telling_deviations * reading_m)
    p.dither_m = std::max(max_dither_m, 2.0 * count_m) / std::numbers::sqrt2;

  p.delay_m = motion.amplitude_m / std::numbers::sqrt2 * turn * channel.heater.delay_s *
              std::min(1.0, turn / bandwidth);
  p.pwm_m = pwm_ripple_m(channel, board, bandwidth);
  p.unexplained_m =
      std::sqrt(unexplained_ratio(channel)) * motion.amplitude_m * std::min(1.0, turn / bandwidth);
  return p;
}

ChannelSettings with_known(ChannelSettings channel, const KnownMuscle& known) {
  control::PhysicalParameters& m = channel.muscle;
  for (std::size_t i = 0; i < control::physical_ranges.size(); ++i)
    m.*control::physical_ranges[i].member = known[i];
  channel.calibration = {.position_offset_m = known[known_position_offset],
                         .position_scale = known[known_position_scale],
                         .cold_resistance_Ohm = known[known_cold_resistance]};
  channel.response_ratio = known[known_response_ratio];
  const double unexplained = known[known_unexplained_ratio];
  channel.muscle_identified = !std::isnan(unexplained);
  channel.unexplained_ratio = channel.muscle_identified ? unexplained : 0.0;
  return channel;
}

}  // namespace supercoil
