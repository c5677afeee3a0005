#include "loop/joint.hpp"

#include <algorithm>

#include "supercoil/control/joint/allocation.hpp"

namespace supercoil {

Joint::Joint(const JointSettings& settings, Axis& agonist, Axis& antagonist, double step_s)
    : settings_(settings),
      agonist_(agonist),
      antagonist_(antagonist),
      first_W_(settings.co_contraction_W),
      max_W_(settings.max_co_contraction_W),
      lag_ratio_(step_s / co_contraction_lag_s) {
  agonist_.limit_reverse_travel(antagonist_.max_travel_m() / settings_.antagonist_lever_ratio);
}

double Joint::gain_ratio() const {
  return settings_.gain_ratio(agonist_.dc_gain_m_per_W(), antagonist_.dc_gain_m_per_W());
}

void Joint::observe() {
  const double ratio = gain_ratio();
  const double lever_ratio = settings_.antagonist_lever_ratio;
  const Opposition of_antagonist = antagonist_.opposition(ratio, 1.0 / lever_ratio);
  antagonist_.oppose(agonist_.opposition(1.0 / ratio, lever_ratio));
  agonist_.oppose(of_antagonist);
  agonist_.limit_pull(max_W_);
  antagonist_.limit_pull(max_W_ / ratio);
}

/// The antagonist's reference is what it is to pull with while the joint asks for no effort.
void Joint::follow_co_contraction(bool active, double gain_ratio) {
  if (!active) {
    nearly_W_ = co_contraction_W_ = 0.0;
  } else if (!was_active_) {
    antagonist_.pull_with(std::min(first_W_ / gain_ratio, antagonist_.heater().limiter().max_W()));
  }
  was_active_ = active;
  if (!active) return;
  // What was commanded may be more than the limit once the muscles are known better.
  const double wanted_W = std::min(gain_ratio * antagonist_.reference(), max_W_);
  nearly_W_ += lag_ratio_ * (wanted_W - nearly_W_);
  co_contraction_W_ += lag_ratio_ * (nearly_W_ - co_contraction_W_);
}

/// Each muscle by itself. What was commanded may be more than the limit once the muscles are known
/// better.
void Joint::limit_each(double gain_ratio) {
  const double agonist_W = agonist_.demanded_W();
  double antagonist_W = antagonist_.demanded_W();
  const double max_antagonist_W = max_W_ / gain_ratio;
  if (agonist_W > max_W_ && antagonist_W > max_antagonist_W) antagonist_W = max_antagonist_W;
  agonist_.limit(agonist_W);
  antagonist_.limit(antagonist_W);
}

void Joint::limit() {
  const bool active = agonist_.follows_position();
  const double ratio = gain_ratio();
  follow_co_contraction(active, ratio);
  if (!active) return limit_each(ratio);
  const control::JointAllocation allocation(ratio);
  const double effort_W = agonist_.demanded_W();
  control::PairPower power = allocation.divide(
      effort_W, co_contraction_W_, {agonist_.allowed_range(), antagonist_.allowed_range()});
  // What neither can give is asked of the one that should: its limiter then says so.
  const double missing_W = effort_W - allocation.effort_W(power);
  if (missing_W > 0.0) power.agonist_W += missing_W;
  if (missing_W < 0.0) power.antagonist_W -= missing_W / ratio;
  agonist_.limit(power.agonist_W);
  antagonist_.limit(power.antagonist_W);
}

}  // namespace supercoil
