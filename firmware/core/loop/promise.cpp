#include "loop/promise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "supercoil/control/thermal/interval_observer.hpp"

#include "board/known_heat.hpp"
#include "modes/identify.hpp"
#include "supervisor/proof.hpp"

namespace supercoil {

namespace {

/// Of the travel. A nonlinear muscle takes up to twice the power where it is hot, and no more can
/// be held: this leaves room for it and also keeps the power clear of 0.
constexpr double middle_ratio = 0.4;
constexpr double amplitude_ratio = 0.16;
constexpr double slower_than_fastest = 1.2;
/// If identify had to shorten its strokes, they say nothing about the upper travel.
constexpr double short_strokes_ratio = 0.7;
/// A faster sine shows nothing more than this one, which a person can see.
constexpr double min_period_s = 5.0;
/// A slower sine only takes longer: a smaller sine of this period shows a slow muscle too.
constexpr double max_period_s = 36.0;

/// The error differs between periods, and the motion differs from that of identify: of 200 muscles
/// (tests/setup/setup_study.cpp, 1 to 200) 97 % stay below.
constexpr double allowance = 1.8;
/// Effect of each tick's white noise in a loop of this bandwidth, including what its damping adds.
constexpr double noise_gain = 2.5;
/// Ratio of motion faster than a drift to sensor noise above which no dither is needed.
constexpr double min_snr_without_dither = 20.0;
/// Below, expect ringing (docs/control.md).
constexpr double ringing_margin = 0.3;
/// As in dither_for.
constexpr double max_dither_m = 20e-6;
/// About a step of the proof.
constexpr double proof_step_s = 0.01;
/// Used until identify has measured what the linear model leaves unexplained: four of five random
/// muscles (tests/setup/setup_study.cpp, 1001 to 1200) leave less.
constexpr double default_unexplained_ratio = 0.015;

/// Ripple of power that is rounded to the PWM's steps. With error feedback the next tick returns
/// what one took; without it a rounding lasts until the controller notices.
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

/// A muscle stored before this ratio was introduced may have as much as identify accepts.
double unexplained_ratio(const ChannelSettings& channel) {
  if (channel.unexplained_ratio > 0.0) return channel.unexplained_ratio;
  if (channel.simulated.linear) return 0.0;
  return channel.muscle_identified ? modes::Identify::Settings{}.max_unexplained
                                   : default_unexplained_ratio;
}

/// Amplitude over that of the widest sine; a faster one has its power swing, P = (x + τẋ)/gain.
double amplitude_at(double period_s, double widest_period_s) {
  // The widest period is slower_than_fastest times 2πτ/√3, as in f.half_travel_period_s.
  const double widest = std::numbers::sqrt3 / slower_than_fastest;
  const double quicker = widest * std::fmax(1.0, widest_period_s / period_s);
  return std::hypot(1.0, widest) / std::hypot(1.0, quicker);
}

/// Rms motion that dithers cause in the motion's last period, without what the feedback corrects:
/// the proof as it runs on the linear muscle without noise.
double dithered_m(const ChannelSettings& channel, const BoardSettings& board,
                  const FirstMotion& motion) {
  const ProofSettings settings = proof_settings(channel, board);
  Proof proof(settings, channel.muscle, true, board.rate_Hz);
  const std::int64_t ticks = std::max<std::int64_t>(1, std::llround(proof_step_s * board.rate_Hz));
  const double step_s = static_cast<double>(ticks) * board.step_s();
  ExpectedMotion followed(channel.muscle, step_s, settings.response_ratio);
  ExpectedMotion dithered = followed;
  control::BasicIntervalObserver<double> heat(
      board::known_thermal_bounds(channel.thermal, channel.heat).bounds, step_s);
  const double turn = 2.0 * std::numbers::pi / motion.period_s;
  const double lead_s = -1.0 / channel.muscle.thermal_pole_rad_per_s();
  const auto steps = std::llround(motion.end_s() / step_s);
  const auto judged = std::llround(motion.settled_s() / step_s);
  double square_sum_m2 = 0.0;
  for (std::int64_t i = 0; i < steps; ++i) {
    const double angle = turn * step_s * static_cast<double>(i);
    const double asked_m = motion.middle_m + load_m(channel) -
                           motion.amplitude_m * (std::cos(angle) - turn * lead_s * std::sin(angle));
    const double asked_W = std::max(0.0, asked_m / channel.muscle.dc_gain_m_per_W());
    const double max_W = std::min(channel.limiter.max_W, proof.max_W());
    const double power_W = std::clamp(proof.with_dither_W(asked_W, max_W), 0.0, max_W);
    heat.step(settings.max_power_ratio * power_W);
    const double off_m = dithered.step(power_W - asked_W);
    if (i >= judged) square_sum_m2 += off_m * off_m;
    proof.step(
        {power_W, power_W - asked_W, ticks, true, followed.step(power_W), heat.max_K(), true, 0.0});
  }
  return std::sqrt(square_sum_m2 / static_cast<double>(steps - judged));
}

}  // namespace

double FirstMotion::at(double time_s) const {
  // Rises along the sine itself: no step at the beginning.
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
  const double below_s =
      below > -1.0 ? motion.period_s / std::numbers::pi * std::acos(below) : INFINITY;
  // In less time the power rises again, which measures the resistance before it is old.
  const double every_s = channel.heater.probe_every_s;
  if (below_s > every_s) {
    const double peak_m = gain * probe_W * std::min(1.0, channel.heater.probe_s / tau_s);
    // The rms of peaks that decay with the muscle's time constant.
    p.probe_m = peak_m * std::min(1.0, std::sqrt(0.5 * tau_s / every_s));
  }

  // If the motion itself shows too little, a dither tests whether the muscle still responds.
  const double fast_motion_m =
      motion.amplitude_m * turn / std::hypot(turn, motion_corner_rad_per_s);
  if (channel.supervision.proof_of_response && fast_motion_m < min_snr_without_dither * reading_m)
    p.dither_m = std::max(max_dither_m, 2.0 * count_m) / std::numbers::sqrt2;
  // A quick muscle that may be quickly too hot is tested already where a larger motion turns.
  if (channel.supervision.proof_of_response)
    p.dither_m = std::max(p.dither_m, dithered_m(channel, board, motion));

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
