// A motion sent ahead of time, as knots that it passes at their times.
#pragma once

#include <array>
#include <cstddef>

#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::control {

/// A trajectory's position and velocity at a time.
struct Knot {
  double time_s = 0.0;  ///< since the trajectory started
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
};

/// The piece from one knot to the next: the polynomial of degree five with the position, velocity
/// and acceleration of both.
class QuinticPiece {
 public:
  /// An end of the piece.
  struct End {
    Knot knot;
    double acceleration_m_per_s2 = 0.0;
  };
  /// to is later than from.
  QuinticPiece(const End& from, const End& to);
  /// time_s: between the times of the two knots.
  TrajectoryPoint at(double time_s) const;
  double begins_s() const { return begins_s_; }
  double duration_s() const { return duration_s_; }

 private:
  double begins_s_;
  double duration_s_;
  std::array<double, 6> coefficient_;
};

/// Position, velocity and acceleration are continuous. The acceleration at a knot is the slope of
/// the chord between its neighbours' velocities: known once the next knot is, and 0 at the last
/// one. Once the piece to a knot has begun, later knots no longer change it.
class Trajectory {
 public:
  static constexpr std::size_t capacity = 64;

  /// Forgets all knots and rests at this position from time 0 on.
  void start(double position_m);

  std::size_t room() const { return capacity - count_; }
  /// The last knot passed; before the start, the first one.
  const Knot& passed() const { return end(0).knot; }
  /// The last knot added; at first the one at rest.
  const Knot& last() const { return end(count_ - 1).knot; }
  /// The pieces not yet begun, with one more knot.
  struct Preview {
    std::array<QuinticPiece, 2> pieces;  ///< to the last knot, and from there to the next one
    std::size_t first;                   ///< 1: the first of them is unchanged, or there is none
  };
  /// What add(next) would change. next: later than the last knot.
  Preview preview(const Knot& next) const;
  /// next: later than the last knot, with room for it.
  void add(const Knot& next);

  /// The motion at time_s >= 0, which must not decrease. It rests after the last knot.
  TrajectoryPoint at(double time_s);

 private:
  const QuinticPiece::End& end(std::size_t place) const {
    return ends_[(first_ + place) % capacity];
  }
  double acceleration_at_last(const Knot& next) const;

  std::array<QuinticPiece::End, capacity> ends_{};  ///< a ring
  std::size_t first_ = 0;                           ///< the knot that was passed last
  std::size_t count_ = 1;
  bool begun_ = false;  ///< the piece from first_ to the next
};

}  // namespace supercoil::control
