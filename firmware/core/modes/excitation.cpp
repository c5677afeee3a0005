#include "modes/excitation.hpp"

#include <algorithm>

namespace supercoil::modes {

bool Excitation::stalled() {
  if (phase_s_ < check_s_) return false;
  const double all_m = std::abs(position_m_ - begin_m_);
  const double towards = phase_ == Phase::search || phase_ == Phase::heat ? 1.0 : -1.0;
  const double late_m = towards * (position_m_ - check_m_);
  check_s_ *= 1.5;
  check_m_ = position_m_;
  if (phase_s_ < std::max(min_phase_s, min_phase_ratio * longest_s_)) return false;
  const bool never_moved = phase_ == Phase::rest && all_m < min_m();
  return never_moved || late_m < 0.05 * all_m;
}

void Excitation::end_search(double ahead_m) {
  const double top_m = std::min(travel_ratio * settings_.max_travel_m, ahead_m);
  reach_m_ = std::max(position_m_, top_m) - cold_m_;
  too_still_ = reach_m_ < min_m();
}

void Excitation::adapt_power(bool reached, double max_W) {
  if (!reached) power_W_ *= 1.2;
  if (reached && phase_s_ < 1.0) power_W_ *= 0.7;
  power_W_ = std::min(power_W_, max_W);
}

/// A linear muscle is held by as much power per metre as it got so far: over whole strokes, the
/// heat that it stores hardly counts.
double Excitation::cooling_W() const {
  const double ratio_W = cooling_ratio * power_W_;
  if (risen_m_s_ <= 0.0) return ratio_W;
  return std::min(ratio_W, held_ratio * reach_m_ * energy_J_ / risen_m_s_);
}

double Excitation::next_W(double position_m, double max_W) {
  time_s_ += settings_.step_s;
  phase_s_ += settings_.step_s;
  const double gain = std::min(1.0, settings_.step_s / smoothing_s);
  const double before_m = position_m_;
  position_m_ += gain * (position_m - position_m_);
  speed_m_per_s_ += gain * ((position_m_ - before_m) / settings_.step_s - speed_m_per_s_);
  const double ahead_m = position_m_ + lag_s * speed_m_per_s_;
  const bool still = stalled();
  switch (phase_) {
    case Phase::rest:
      if (still) {
        cold_m_ = position_m_;
        power_W_ = first_ratio * max_W;
        begin(Phase::search);
      }
      return 0.0;
    case Phase::search:
      power_W_ = std::min(max_W, power_W_ * std::exp(settings_.step_s / growth_s));
      if (ahead_m >= travel_ratio * settings_.max_travel_m || (still && power_W_ >= max_W) ||
          position_m_ - cold_m_ < -backwards_ratio * settings_.max_travel_m ||
          (phase_s_ > max_still_s && position_m_ - cold_m_ < min_m())) {
        end_search(ahead_m);
        begin(Phase::cool);
      }
      return power_W_;
    case Phase::heat:
      if (const bool reached = ahead_m >= level_m(highs); reached || still) {
        adapt_power(reached, max_W);
        begin(Phase::cool);
      }
      return power_W_ * (0.87 + 0.13 * sines());
    case Phase::cool:
      if (cycle_ == 0) slow_ = phase_s_ > slow_s && ahead_m <= cold_m_ + slow_low * reach_m_;
      if (still || (slow_ && cycle_ == 0) || ahead_m <= level_m(lows)) {
        ++cycle_;
        begin(Phase::heat);
      }
      return cooling_W() * (1.0 + sines());
  }
  return 0.0;
}

}  // namespace supercoil::modes
