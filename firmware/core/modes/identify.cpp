#include "modes/identify.hpp"

#include <array>
#include <cmath>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::modes {

namespace {

constexpr std::array<std::uint8_t, 3> uncertain_notes{note_theta2_uncertain, note_theta3_uncertain,
                                                      note_theta4_uncertain};
constexpr std::uint8_t uncertain = note_theta3_uncertain | note_theta4_uncertain;

}  // namespace

using Fit = control::BatchLeastSquares::Fit;

bool Identify::knows(const Fit& fit, int i) const {
  const bool slow_theta4 = i == 3 && excitation_.slow();
  const double max_deviation =
      slow_theta4 ? settings_.max_slow_theta4_deviation : settings_.max_deviation;
  return fit.theta[i] > 0.0 && fit.deviation[i] <= max_deviation &&
         fit.holdout_difference[i] <= settings_.max_difference;
}

/// On a nonlinear muscle no θ2 suits all motions, and feedback uses it only for damping.
bool Identify::usable_theta2(const Fit& fit) const {
  return plausible(fit.theta[1], control::theta_from(believed_)[1]) &&
         fit.deviation[1] <= settings_.max_theta2_deviation;
}

bool Identify::plausible(double theta, double believed) const {
  const double ratio = theta / believed;
  return ratio >= settings_.min_ratio && ratio <= settings_.max_ratio;
}

/// The found θ1, or the believed one scaled to the pace of the muscle that was found: θ1/θ3 is
/// about 1/ϱ, which does not depend on γ. The resulting muscle must be stable, θ2 θ3 > θ1 m̂ θ4.
double Identify::theta1(const Fit& fit) {
  const control::Theta believed = control::theta_from(believed_);
  const double scaled = believed[0] * fit.theta[2] / believed[2];
  if (knows(fit, 0) && plausible(fit.theta[0], scaled)) return fit.theta[0];
  notes_ |= note_theta1_kept;
  const double limit = fit.theta[1] * fit.theta[2] / (fit.theta[3] * believed_.moving_mass_kg);
  return std::fmin(scaled, 0.5 * limit);
}

/// Everything that speaks against the fit.
std::uint8_t Identify::reasons_against(const Fit& fit) const {
  const control::Theta believed = control::theta_from(believed_);
  unsigned notes = fit.unexplained_ratio <= settings_.max_unexplained ? 0 : note_poor_fit;
  for (int i = 1; i < 4; ++i) {
    if (!knows(fit, i)) {
      notes |= uncertain_notes.at(static_cast<std::size_t>(i - 1));
    } else if (!plausible(fit.theta[i], believed[i])) {
      notes |= note_implausible;
    }
  }
  return static_cast<std::uint8_t>(notes);
}

ModeResult Identify::judge() {
  if (excitation_.too_little_motion()) {
    if (excitation_.moved_backwards()) return ModeResult::moved_backwards;
    notes_ = note_too_little_motion;
    return ModeResult::too_little_motion;
  }
  const auto fit = fit_.fit();
  notes_ = fit ? reasons_against(*fit) : uncertain;
  theta_ = fit ? fit->theta : control::Theta::Constant(NAN);
  double unexplained_ratio = fit ? fit->unexplained_ratio : NAN;
  if (fit && shortened()) {
    const double of_full_ratio = fit_.unexplained_ratio(full_strokes_, fit->theta);
    if (!(of_full_ratio <= settings_.max_unexplained_full)) notes_ |= note_poor_fit;
    unexplained_ratio = std::fmax(unexplained_ratio, of_full_ratio);
  }
  if ((notes_ & note_poor_fit) != 0) return ModeResult::poor_fit;
  if ((notes_ & uncertain) != 0 || !usable_theta2(*fit)) return ModeResult::uncertain;
  if ((notes_ & note_implausible) != 0) return ModeResult::implausible;

  control::Theta theta = fit->theta;
  theta[0] = theta1(*fit);
  const auto physical =
      control::physical_from(theta, {believed_.force_per_kelvin_N_per_K, believed_.moving_mass_kg});
  if (!physical) {
    notes_ = note_implausible;
    return ModeResult::implausible;
  }
  found_ = *physical;
  quality_ = {fit->deviation, unexplained_ratio};
  for (int i = 0; i < 4 && shortened() && full_theta_.allFinite(); ++i) {
    quality_.deviation_ratio[i] =
        std::hypot(quality_.deviation_ratio[i], full_theta_[i] / fit->theta[i] - 1.0);
  }
  if ((notes_ & note_theta1_kept) != 0) quality_.deviation_ratio[0] = NAN;
  if (shortened()) notes_ |= note_poor_fit;
  return ModeResult::found;
}

ModeResult Identify::shorten(ModeResult reason) {
  if (shortened_ == 0) {
    full_strokes_ = fit_.experiment();
    full_theta_ = theta_;
    full_result_ = reason;
    full_notes_ = notes_;
  }
  ++shortened_;
  ++repeats_;
  excitation_.start_shorter();
  fit_.restart();
  return go_on();
}

ModeResult Identify::conclude(bool ends) {
  const ModeResult result = judge();
  const bool in_time = elapsed_s_ < settings_.max_s;
  const bool can_shorten = in_time && shortened_ < max_shortened;
  if (result == ModeResult::found) return result;
  if (result == ModeResult::poor_fit && can_shorten) return shorten(result);
  if (!ends) return go_on();
  if (result == ModeResult::uncertain && in_time && excitation_.go_on()) {
    ++repeats_;
    return go_on();
  }
  if (shortened_ == 0 && result != ModeResult::uncertain) return result;
  if (can_shorten) return shorten(result);
  if (shortened_ == 0) return result;
  // Whatever the shorter strokes' result, the full ones did not find the muscle either.
  notes_ |= full_notes_;
  return full_result_;
}

}  // namespace supercoil::modes
