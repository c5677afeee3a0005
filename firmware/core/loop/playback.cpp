#include "loop/playback.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supercoil {

/// P = θ1 m̂x⃛ + θ2 ẍ + θ3 ẋ + θ4 x, as in ReferenceShaper, averaged over each part of the piece.
bool Playback::is_feasible(const control::QuinticPiece& piece, const Capability& capability) {
  constexpr double max_parts = 8.0;
  const auto parts = static_cast<int>(std::clamp(piece.duration_s() / smoothed_s, 1.0, max_parts));
  const double part_s = piece.duration_s() / parts;
  const double margin_W = margin_ratio * capability.range.max_W;
  // Where nothing pulls the muscle below rest, only its power is judged.
  const double reverse_m = capability.max_reverse_travel_m;
  constexpr double unlimited_m = -std::numeric_limits<double>::infinity();
  const double min_m = reverse_m > 0.0 ? lowest_m(reverse_m) : unlimited_m;
  control::ModelMotion<double> from = piece.at(piece.begins_s()).motion;
  for (int i = 1; i <= parts; ++i) {
    const control::ModelMotion<double> to = piece.at(piece.begins_s() + i * part_s).motion;
    const double needed_W = capability.theta[0] * capability.moving_mass_kg *
                                (to.acceleration - from.acceleration) /
                                std::max(part_s, smoothed_s) +
                            capability.theta[1] * (to.velocity - from.velocity) / part_s +
                            capability.theta[2] * (to.position - from.position) / part_s +
                            capability.theta[3] * 0.5 * (from.position + to.position);
    const bool possible = needed_W >= capability.range.min_W - margin_W &&
                          needed_W <= capability.range.max_W + margin_W && to.position >= min_m &&
                          to.position <= float_rounding * capability.max_travel_m;
    if (!possible) return false;  // also for NaN
    from = to;
  }
  return true;
}

Reply Playback::add(const Command& command, const Capability& capability) {
  const double min_m = lowest_m(capability.max_reverse_travel_m);
  const double max_m = float_rounding * capability.max_travel_m;
  const auto velocity = static_cast<double>(command.velocity_m_per_s);
  const auto after_s = static_cast<double>(command.after_s);
  if (!(command.value >= min_m && command.value <= max_m))
    return {Refusal::out_of_range, std::clamp(command.value, min_m, max_m)};
  if (!std::isfinite(velocity) || !(after_s >= 0.0 && after_s <= max_after_s))
    return Refusal::out_of_range;
  if (after_s == 0.0) return begin(command.value, velocity);
  if (state_ == PlaybackState::empty) return Refusal::wrong_state;
  const control::Knot next{trajectory_.last().time_s + after_s, command.value, velocity};
  // After its end a trajectory cannot be continued.
  if (runs() && trajectory_.last().time_s <= time_s_) return Refusal::wrong_state;
  if (trajectory_.room() == 0) return Refusal::queue_full;
  const auto preview = trajectory_.preview(next);
  for (std::size_t i = preview.first; i < preview.pieces.size(); ++i) {
    if (!is_feasible(preview.pieces[i], capability)) return Refusal::infeasible;
  }
  trajectory_.add(next);
  publish();
  return Refusal::none;
}

Reply Playback::begin(double position_m, double velocity_m_per_s) {
  if (state_ == PlaybackState::waiting || state_ == PlaybackState::playing) return Refusal::busy;
  if (velocity_m_per_s != 0.0) return Refusal::out_of_range;
  forget();
  trajectory_.start(position_m);
  state_ = PlaybackState::loaded;
  publish();
  return Refusal::none;
}

Reply Playback::start(hal::Time at, hal::Time now, double reference_m, Source source) {
  if (state_ != PlaybackState::loaded) return Refusal::wrong_state;
  if (at < now) return Refusal::out_of_range;
  if (hal::seconds(at - now) > max_ahead_s) return Refusal::out_of_range;
  if (std::abs(reference_m - trajectory_.passed().position_m) > max_gap_m)
    return Refusal::not_ready;
  wanted_ahead_s_.store(0.0, std::memory_order_relaxed);
  aligns_ = source == Source::can;
  starts_ = at;
  last_tick_ = now;
  state_ = PlaybackState::waiting;
  publish();
  return Refusal::none;
}

void Playback::forget() {
  if (state_ == PlaybackState::empty) return;
  state_ = PlaybackState::empty;
  trajectory_.start(0.0);
  time_s_ = ahead_s_ = dry_s_ = 0.0;
  publish();
}

double Playback::step(hal::Time now, double reference_m) {
  point_.reset();
  if (state_ < PlaybackState::waiting) return reference_m;
  const double elapsed_s = hal::seconds(now - last_tick_);
  last_tick_ = now;
  if (state_ == PlaybackState::waiting) {
    if (now < starts_) return reference_m;
    time_s_ = hal::seconds(now - starts_);
  } else {
    const double off_s = wanted_ahead_s_.load(std::memory_order_relaxed) - ahead_s_;
    const double max_s = max_slew_ratio * elapsed_s;
    if (aligns_ && std::abs(off_s) <= max_align_s) ahead_s_ += std::clamp(off_s, -max_s, max_s);
    time_s_ = hal::seconds(now - starts_) + ahead_s_;
  }
  const control::Knot& last = trajectory_.last();
  const bool rests = last.velocity_m_per_s == 0.0;
  state_ = time_s_ < last.time_s ? PlaybackState::playing
           : rests               ? PlaybackState::ended
                                 : PlaybackState::dry;
  dry_s_ = state_ == PlaybackState::dry ? dry_s_ + elapsed_s : 0.0;
  publish();
  const control::TrajectoryPoint at = trajectory_.at(time_s_);
  if (state_ == PlaybackState::playing) point_ = at;
  return at.motion.position;
}

void Playback::publish() {
  const double left_s = state_ == PlaybackState::empty ? 0.0 : trajectory_.last().time_s - time_s_;
  status_.store({state_, static_cast<std::uint8_t>(trajectory_.room()),
                 static_cast<float>(std::max(0.0, left_s))},
                std::memory_order_relaxed);
}

}  // namespace supercoil
