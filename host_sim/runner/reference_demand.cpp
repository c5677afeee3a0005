#include "runner/reference_demand.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

namespace {

double load_W(const control::PhysicalParameters& muscle, double load_N) {
  return load_N / muscle.stiffness_N_per_m / muscle.dc_gain_m_per_W();
}

}  // namespace

ReferenceDemand::ReferenceDemand(const Conditions& c, const control::PhysicalParameters& muscle,
                                 double load_N, const PowerLeft& left, double step_s,
                                 double tolerated_ratio)
    : step_s_(step_s),
      range_{c.power.min_W, c.power.max_W},
      tolerated_W_(tolerated_ratio * c.power.max_W),
      given_ratio_(c.power.gain),
      gain_m_per_W_(muscle.dc_gain_m_per_W()),
      load_W_(load_W(muscle, load_N)),
      motion_(c, step_s),
      lag_(muscle, step_s),
      left_(left),
      cold_(left_.cold()) {}

void ReferenceDemand::change(const Conditions& c, const control::PhysicalParameters& muscle,
                             double load_N) {
  range_ = {c.power.min_W, c.power.max_W};
  given_ratio_ = c.power.gain;
  gain_m_per_W_ = muscle.dc_gain_m_per_W();
  load_W_ = load_W(muscle, load_N);
  WantedMotion motion(c, step_s_);
  motion.go_on_from(motion_);
  motion_ = motion;
  Lag lag(muscle, step_s_);
  lag.go_on_from(lag_);
  lag_ = lag;
}

ReferenceDemand::Excess ReferenceDemand::step(double reference_m) {
  const PowerLeft::Most most = left_.now();
  const double max_W = std::min(most.power_W, range_.max_W);
  motion_.leave(max_W);
  const double of_motion_W = motion_.power_W(reference_m);
  const double asked_W = (of_motion_W + load_W_) / given_ratio_;
  const double needed_W = (motion_.left_W(of_motion_W) + load_W_) / given_ratio_;
  motion_.step(reference_m);
  const double wanted_W = needed_W + lag_.made_up_by_W();
  // min_W for NaN; std::fmin would be a call.
  const double given_W = std::min(max_W, std::max(range_.min_W, wanted_W));
  left_.step(given_W);
  lag_.step(needed_W - given_W);

  Excess excess{.power_W = std::max(range_.min_W - asked_W, asked_W - max_W),
                .unmet = wanted_W > max_W + unmet_ratio * range_.max_W};
  const double off_W =
      lag_.off_W() + std::abs(motion_.asked_m() - motion_.shaped_m()) / gain_m_per_W_;
  const bool behind = off_W > tolerated_W_;
  const double tolerated_W = behind ? rounding_ratio * range_.max_W : tolerated_W_;
  const double least_W = behind ? std::min(asked_W, wanted_W) : asked_W;
  const double most_W = behind ? std::max(asked_W, wanted_W) : asked_W;
  if (least_W < range_.min_W - tolerated_W) {
    excess.by = LimitedBy::cooling;
  } else if (most_W > max_W + tolerated_W) {
    // Heat is not the reason if a cold muscle could not follow either.
    excess.by = asked_W > cold_.power_W + tolerated_W ? cold_.by : most.by;
  }
  return excess;
}

}  // namespace supercoil::host_sim
