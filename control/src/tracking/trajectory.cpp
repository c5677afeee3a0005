#include "supercoil/control/tracking/trajectory.hpp"

namespace supercoil::control {

QuinticPiece::QuinticPiece(const End& from, const End& to)
    : begins_s_(from.knot.time_s), duration_s_(to.knot.time_s - from.knot.time_s) {
  const double t = duration_s_;
  const double way = to.knot.position_m - from.knot.position_m;
  const double v0 = from.knot.velocity_m_per_s * t;
  const double v1 = to.knot.velocity_m_per_s * t;
  const double a0 = from.acceleration_m_per_s2 * t * t;
  const double a1 = to.acceleration_m_per_s2 * t * t;
  // In powers of time over the duration.
  coefficient_ = {from.knot.position_m,
                  v0,
                  0.5 * a0,
                  10.0 * way - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1,
                  -15.0 * way + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1,
                  6.0 * way - 3.0 * (v0 + v1) - 0.5 * (a0 - a1)};
}

TrajectoryPoint QuinticPiece::at(double time_s) const {
  const auto& c = coefficient_;
  const double t = duration_s_;
  const double x = (time_s - begins_s_) / t;
  TrajectoryPoint p;
  p.motion.position = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
  p.motion.velocity =
      (c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5])))) / t;
  p.motion.acceleration =
      (2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5]))) / (t * t);
  p.jerk = (6.0 * c[3] + x * (24.0 * c[4] + x * 60.0 * c[5])) / (t * t * t);
  return p;
}

void Trajectory::start(double position_m) {
  first_ = 0;
  count_ = 1;
  begun_ = false;
  ends_[0] = {{0.0, position_m, 0.0}, 0.0};
}

/// 0 when the piece to the last knot has begun, or there is no knot before it.
double Trajectory::acceleration_at_last(const Knot& next) const {
  const bool settled = count_ == 1 || (count_ == 2 && begun_);
  if (settled) return end(count_ - 1).acceleration_m_per_s2;
  const Knot& before = end(count_ - 2).knot;
  return (next.velocity_m_per_s - before.velocity_m_per_s) / (next.time_s - before.time_s);
}

Trajectory::Preview Trajectory::preview(const Knot& next) const {
  const QuinticPiece::End last{end(count_ - 1).knot, acceleration_at_last(next)};
  const QuinticPiece to_next(last, {next, 0.0});
  const bool settled = count_ == 1 || (count_ == 2 && begun_);
  if (settled) return {{to_next, to_next}, 1};
  return {{QuinticPiece(end(count_ - 2), last), to_next}, 0};
}

void Trajectory::add(const Knot& next) {
  ends_[(first_ + count_ - 1) % capacity].acceleration_m_per_s2 = acceleration_at_last(next);
  ends_[(first_ + count_) % capacity] = {next, 0.0};
  ++count_;
}

TrajectoryPoint Trajectory::at(double time_s) {
  while (count_ > 1 && time_s >= end(1).knot.time_s) {
    first_ = (first_ + 1) % capacity;
    --count_;
    begun_ = false;
  }
  if (count_ == 1) {
    TrajectoryPoint rest;
    rest.motion.position = end(0).knot.position_m;
    return rest;
  }
  begun_ = true;
  return QuinticPiece(end(0), end(1)).at(time_s);
}

}  // namespace supercoil::control
