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
                                 double load_N, const AvailablePower& available, double step_s,
                                 double tolerated_ratio)
    : step_s_(step_s),
      range_{c.power.min_W, c.power.max_W},
      tolerated_W_(tolerated_ratio * c.power.max_W),
      given_ratio_(c.power.gain),
      gain_m_per_W_(muscle.dc_gain_m_per_W()),
      load_W_(load_W(muscle, load_N)),
      motion_(c, step_s),
      lag_(muscle, step_s),
      available_(available),
      cold_(available_.cold()) {}

void ReferenceDemand::change(const Conditions& c, const control::PhysicalParameters& muscle,
                             double load_N) {
  range_ = {c.power.min_W, c.power.max_W};
  given_ratio_ = c.power.gain;
  gain_m_per_W_ = muscle.dc_gain_m_per_W();
  load_W_ = load_W(muscle, load_N);
  DemandedMotion motion(c, step_s_);
  motion.continue_from(motion_);
  motion_ = motion;
  Lag lag(muscle, step_s_);
  lag.continue_from(lag_);
  lag_ = lag;
}

ReferenceDemand::Excess ReferenceDemand::step(double reference_m) {
  const AvailablePower::Limit limit = available_.now();
  const double max_W = std::min(limit.power_W, range_.max_W);
  motion_.set_max_W(max_W);
  const double motion_W = motion_.power_W(reference_m);
  const double demanded_W = (motion_W + load_W_) / given_ratio_;
  const double needed_W = (motion_.feasible_W(motion_W) + load_W_) / given_ratio_;
  motion_.step(reference_m);
  const double required_W = needed_W + lag_.catch_up_W();
  // min_W for NaN; std::fmin would be a call.
  const double given_W = std::min(max_W, std::max(range_.min_W, required_W));
  available_.step(given_W);
  lag_.step(needed_W - given_W);

  Excess excess{.power_W = std::max(range_.min_W - demanded_W, demanded_W - max_W),
                .unmet = required_W > max_W + unmet_ratio * range_.max_W};
  const double error_W =
      lag_.error_W() + std::abs(motion_.demanded_m() - motion_.shaped_m()) / gain_m_per_W_;
  const bool behind = error_W > tolerated_W_;
  const double tolerated_W = behind ? rounding_ratio * range_.max_W : tolerated_W_;
  const double min_demand_W = behind ? std::min(demanded_W, required_W) : demanded_W;
  const double max_demand_W = behind ? std::max(demanded_W, required_W) : demanded_W;
  if (min_demand_W < range_.min_W - tolerated_W) {
    excess.by = LimitedBy::cooling;
  } else if (max_demand_W > max_W + tolerated_W) {
    // Heat is not the reason if a cold muscle could not follow either.
    excess.by = demanded_W > cold_.power_W + tolerated_W ? cold_.by : limit.by;
  }
  return excess;
}

}  // namespace supercoil::host_sim
