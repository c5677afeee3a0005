// A trajectory that was sent ahead, as the reference of mode position.
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
  loaded = 1,   ///< has knots, and is not told to start
  waiting = 2,  ///< for the time at which it starts
  playing = 3,
  ended = 4,  ///< holds the last knot, where it was to rest
  dry = 5,    ///< holds the last knot, in whose motion it was to go on: the next one is missing
};
inline constexpr std::array<std::string_view, 6> playback_state_names{
    "empty", "loaded", "waiting", "playing", "ended", "dry"};

/// What other threads may know of it. Aligned as one word: for less clang calls a library.
struct alignas(8) PlaybackStatus {
  PlaybackState state = PlaybackState::empty;
  std::uint8_t room = 0;    ///< for so many knots more
  float buffered_s = 0.0F;  ///< until the last knot
};

/// Knots are taken while the muscle follows a position, and anything else that it is told forgets
/// them: nothing old is ever played later. What a knot asks for is judged when it comes.
class Playback {
 public:
  /// What the muscle can do, by its linear model.
  struct Able {
    control::Theta theta;
    double moving_mass_kg;
    double max_reverse_travel_m;  ///< below rest
    double max_travel_m;
    control::PowerRange range;
  };

  /// The next knot of `command`. One at once (0 s after the last) is the first of a new trajectory,
  /// at rest.
  Reply add(const Command& command, const Able& able);
  /// At a time of the board's clock, from the position that is followed now. source: a start from
  /// the board itself goes by the board's clock, whatever a bus's master tells.
  Reply start(hal::Time at, hal::Time now, double reference_m, Source source);
  /// From one other thread: its time goes on until it is so far ahead of the board's clock since
  /// the start. No command: it needs no answer, and takes no room from commands. More than 10 ms at
  /// once are another clock's, and ignored.
  void align(double ahead_s) { wanted_ahead_s_.store(ahead_s, std::memory_order_relaxed); }
  void forget();

  /// One tick: where the muscle should be. reference_m: where it is told to be until then.
  double step(hal::Time now, double reference_m);
  /// Where it is at the tick of step(), while it plays.
  const std::optional<control::TrajectoryPoint>& point() const { return point_; }
  /// It has run dry for so long that the muscle is better off at rest.
  bool is_over() const { return dry_s_ > hold_dry_s; }

  /// From any thread.
  PlaybackStatus status() const { return status_.load(std::memory_order_relaxed); }

 private:
  static constexpr double max_ahead_s = 60.0;
  static constexpr double max_after_s = 60.0;
  static constexpr double hold_dry_s = 1.0;
  /// What the 24 bits of a position leave open, and the reading of a reference.
  static constexpr double same_m = 2e-6;
  /// A clock that is off by more is another's.
  static constexpr double max_align_s = 0.01;
  /// Of time: how much faster or slower it goes while it is aligned.
  static constexpr double max_slew_ratio = 1e-3;
  /// What is asked for less long, a jump of the acceleration above all, is asked for so long: a
  /// muscle does not see the difference.
  static constexpr double smoothed_s = 0.1;
  /// Of the greatest power: what a model may be off by before a muscle cannot do what it is told.
  static constexpr double margin_ratio = 0.05;

  Reply begin(double position_m, double velocity_m_per_s);
  static bool is_feasible(const control::QuinticPiece& piece, const Able& able);
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
