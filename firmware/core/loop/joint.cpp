#include "loop/joint.hpp"

#include <algorithm>

#include "supercoil/control/joint/allocation.hpp"

namespace supercoil {

Joint::Joint(const JointSettings& settings, Axis& agonist, Axis& antagonist, double step_s)
    : settings_(settings),
      agonist_(agonist),
      antagonist_(antagonist),
      initial_W_(settings.co_contraction_W),
      max_W_(settings.max_co_contraction_W),
      lag_ratio_(step_s / co_contraction_lag_s),
      inverse_lever_ratio_(1.0 / settings.antagonist_lever_ratio),
      knowledge_{agonist.knowledge(), antagonist.knowledge()},
      gains_(calculated_gains()) {
  agonist_.limit_reverse_travel(antagonist_.max_travel_m() / settings_.antagonist_lever_ratio);
}

Joint::Gains Joint::calculated_gains() const {
  const double ratio =
      settings_.gain_ratio(agonist_.dc_gain_m_per_W(), antagonist_.dc_gain_m_per_W());
  return {ratio, 1.0 / ratio, max_W_ / ratio};
}

const Joint::Gains& Joint::gains() {
  const std::array knowledge{agonist_.knowledge(), antagonist_.knowledge()};
  if (knowledge != knowledge_) {
    knowledge_ = knowledge;
    gains_ = calculated_gains();
  }
  return gains_;
}

void Joint::observe() {
  const Gains& known = gains();
  const Opposition of_antagonist = antagonist_.opposition(known.ratio, inverse_lever_ratio_);
  antagonist_.oppose(agonist_.opposition(known.inverse_ratio, settings_.antagonist_lever_ratio));
  agonist_.oppose(of_antagonist);
  agonist_.limit_pull(max_W_);
  antagonist_.limit_pull(known.max_antagonist_W);
}

/// What each muscle needs beyond its share of the effort, which its heat shows more smoothly than
/// the controller. Co-contraction hardly moves the joint, so it does not raise this need.
double Joint::taut_W(double gain_ratio) const {
  const double half_W = 0.5 * (agonist_.heat_W() - gain_ratio * antagonist_.heat_W());
  const double wanted_W =
      std::max(agonist_.taut_W() - half_W, gain_ratio * antagonist_.taut_W() + half_W);
  return wanted_W > 0.0 ? wanted_W : 0.0;  // also 0 for NaN
}

/// The antagonist's reference is its power while the joint asks for no effort.
void Joint::follow_co_contraction(bool active, double gain_ratio) {
  if (!active) {
    filtered_W_ = co_contraction_W_ = 0.0;
  } else if (!was_active_) {
    antagonist_.pull_with(
        std::min(initial_W_ / gain_ratio, antagonist_.heater().limiter().max_W()));
  }
  was_active_ = active;
  if (!active) return;
  // A command may exceed the limit once the muscles are known better.
  const double wanted_W =
      std::min(std::max(gain_ratio * antagonist_.reference(), taut_W(gain_ratio)), max_W_);
  filtered_W_ += lag_ratio_ * (wanted_W - filtered_W_);
  co_contraction_W_ += lag_ratio_ * (filtered_W_ - co_contraction_W_);
}

/// For muscles that are driven separately. A command may exceed the limit once the muscles are
/// known better.
void Joint::limit_each(double max_antagonist_W) {
  const double agonist_W = agonist_.demanded_W();
  double antagonist_W = antagonist_.demanded_W();
  if (agonist_W > max_W_ && antagonist_W > max_antagonist_W) antagonist_W = max_antagonist_W;
  agonist_.limit(agonist_W);
  antagonist_.limit(antagonist_W);
}

void Joint::limit() {
  const bool active = agonist_.follows_position();
  const Gains& known = gains();
  const double ratio = known.ratio;
  follow_co_contraction(active, ratio);
  if (!active) return limit_each(known.max_antagonist_W);
  const control::JointAllocation allocation(ratio);
  const double effort_W = agonist_.demanded_W();
  control::PairPower power = allocation.divide(
      effort_W, co_contraction_W_, {agonist_.allowed_range(), antagonist_.allowed_range()});
  // The muscle that should give it is asked for the missing power, so that its limiter says why.
  const double missing_W = effort_W - allocation.effort_W(power);
  if (missing_W > 0.0) power.agonist_W += missing_W;
  if (missing_W < 0.0) power.antagonist_W -= missing_W / ratio;
  agonist_.limit(power.agonist_W);
  antagonist_.limit(power.antagonist_W);
}

}  // namespace supercoil
