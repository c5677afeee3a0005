// Plays a trajectory that was sent ahead, as the reference of mode position.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/law.hpp"
#include "supercoil/control/tracking/trajectory.hpp"
#include "supercoil/hal/clock.hpp"

#include "loop/command.hpp"

namespace supercoil {

/// The numbers are those of the protocol.
enum class PlaybackState : std::uint8_t {
  empty = 0,    ///< no knots
  loaded = 1,   ///< has knots, not told to start yet
  waiting = 2,  ///< for its start time
  playing = 3,
  ended = 4,  ///< holds the last knot, which ends at rest
  dry = 5,    ///< holds the last knot, though it ends in motion: the next one is missing
};
inline constexpr std::array<std::string_view, 6> playback_state_names{
    "empty", "loaded", "waiting", "playing", "ended", "dry"};

/// State for other threads. Aligned as one word: otherwise clang calls a library for the atomic.
struct alignas(8) PlaybackStatus {
  PlaybackState state = PlaybackState::empty;
  std::uint8_t room = 0;    ///< how many more knots fit
  float buffered_s = 0.0F;  ///< until the last knot
};

/// Knots are accepted while the muscle follows a position. Any other command clears them, so that
/// nothing old is played later. Each knot is checked when it arrives.
class Playback {
 public:
  /// What the muscle can do, by its linear model.
  struct Capability {
    control::Theta theta;
    double moving_mass_kg;
    double max_reverse_travel_m;  ///< below rest
    double max_travel_m;
    control::PowerRange range;
  };

  /// Adds the knot of `command`. A time of 0 s after the last makes it the first of a new
  /// trajectory, at rest.
  Reply add(const Command& command, const Capability& capability);
  /// Starts at a time of the board's clock, from the position that is followed now. source: a start
  /// from the board itself keeps to the board's clock and ignores a bus's master.
  Reply start(hal::Time at, hal::Time now, double reference_m, Source source);
  /// From one other thread: slews its time until it is this far ahead of the board's clock since
  /// the start. Not a command: it needs no answer and takes no room from commands. A difference of
  /// more than 10 ms comes from another clock and is ignored.
  void align(double ahead_s) { wanted_ahead_s_.store(ahead_s, std::memory_order_relaxed); }
  void forget();

  /// One tick: the reference. reference_m: the one that holds until the trajectory starts.
  double step(hal::Time now, double reference_m);
  /// The trajectory's point at the tick of step(), while it plays.
  const std::optional<control::TrajectoryPoint>& point() const { return point_; }
  /// It has been dry for so long that the muscle should rest.
  bool is_over() const { return dry_s_ > hold_dry_s; }

  /// From any thread.
  PlaybackStatus status() const { return status_.load(std::memory_order_relaxed); }

 private:
  static constexpr double max_ahead_s = 60.0;
  static constexpr double max_after_s = 60.0;
  static constexpr double hold_dry_s = 1.0;
  /// Tolerance for the resolution of a 24-bit position and of a reference that was read.
  static constexpr double max_gap_m = 2e-6;
  /// A larger difference comes from another clock.
  static constexpr double max_align_s = 0.01;
  /// How much faster or slower time runs while it is aligned.
  static constexpr double max_slew_ratio = 1e-3;
  /// Shorter demands, above all a jump of the acceleration, are taken as this long: a muscle does
  /// not see the difference.
  static constexpr double smoothed_s = 0.1;
  /// Over the maximum power: the model error that is allowed for before a knot is infeasible.
  static constexpr double margin_ratio = 0.05;

  Reply begin(double position_m, double velocity_m_per_s);
  static bool is_feasible(const control::QuinticPiece& piece, const Capability& capability);
  bool runs() const { return state_ >= PlaybackState::playing; }
  void publish();

  control::Trajectory trajectory_;
  PlaybackState state_ = PlaybackState::empty;
  hal::Time starts_{};
  hal::Time last_tick_{};
  double time_s_ = 0.0;  ///< since it started, aligned
  double ahead_s_ = 0.0;
  bool aligns_ = false;
  std::atomic<double> wanted_ahead_s_{0.0};
  double dry_s_ = 0.0;
  std::optional<control::TrajectoryPoint> point_;
  std::atomic<PlaybackStatus> status_{};
};
static_assert(std::atomic<PlaybackStatus>::is_always_lock_free);

}  // namespace supercoil
