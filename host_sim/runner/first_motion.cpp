#include "runner/first_motion.hpp"

namespace supercoil::host_sim {

namespace {

ChannelSettings settings_now(const Channel& channel, const ChannelSettings& configured) {
  KnownMuscle known;
  for (std::size_t i = 0; i < known.size(); ++i)
    known[i] = channel.known(i);
  ChannelSettings now = with_known(configured, known);
  now.senses = channel.senses();
  return now;
}

}  // namespace

FirstMotionRun::FirstMotionRun(const Loop& loop, const BoardSettings& board, std::size_t place,
                               double begin_s)
    : begin_s_(begin_s) {
  const Channel& channel = loop.channel(0);
  const ChannelSettings now = settings_now(channel, board.channels.front());
  motion_ = plan_first_motion(feasibility(now, board), now.unexplained_ratio);
  const control::ControllerSettings& controller = now.controllers[place];
  if (!is_promised_for(controller, now, board.step_s())) return;
  promised_rms_m_ = promise_error(controller.learned_ff, now, board, motion_).error_m();
}

double FirstMotionRun::reference_m(double time_s) const {
  const double since_s = time_s - begin_s_;
  return since_s < motion_.end_s() ? motion_.at(since_s) : NAN;
}

void FirstMotionRun::update(double time_s, const Snapshot& snapshot) {
  const double since_s = time_s - begin_s_;
  ended_ = ended_ || since_s >= motion_.end_s();
  if (ended_ || since_s < motion_.settled_s()) return;
  // NaN, also as the rms, unless the muscle follows a position throughout.
  const double error_m =
      snapshot.mode == Mode::position ? snapshot.position_m - snapshot.model_m : NAN;
  square_sum_ += error_m * error_m;
  ++ticks_;
}

double FirstMotionRun::rms_m() const {
  return ended_ && ticks_ > 0 ? std::sqrt(square_sum_ / static_cast<double>(ticks_)) : NAN;
}

}  // namespace supercoil::host_sim
