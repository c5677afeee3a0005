// What a channel does with the other one of its joint.
#include "loop/channel.hpp"

namespace supercoil {

bool Channel::moves_joint() const {
  const Mode moving = leads_ ? Mode::position : Mode::joint;
  return other_ != nullptr && state_.may_heat() && axis_.mode() == moving;
}

bool Channel::led() const {
  return !leads_ && (moves_joint() || (other_ != nullptr && other_->waits_for_other()));
}

/// To follow a position takes both muscles. All else is done by one of them, while the other one is
/// not led; what measures a muscle wants the other one cold.
Refusal Channel::joint_admits(Mode mode, const BoardTick& board) const {
  if (other_ == nullptr) return Refusal::none;
  if (waits_for_other()) return Refusal::busy;
  const bool other_is_alone = other_->state_.may_heat() && !other_->moves_joint();
  if (mode == Mode::position) {
    if (!leads_) return Refusal::wrong_state;
    return other_is_alone ? Refusal::busy : other_->may_heat(board);
  }
  if (led()) return Refusal::busy;
  const bool disturbs = mode != Mode::power || measures(other_->axis_.mode());
  return other_is_alone && disturbs ? Refusal::busy : Refusal::none;
}

void Channel::lead(Mode mode) {
  if (other_ == nullptr || !leads_) return;
  if (mode == Mode::position) {
    if (!moves_joint()) other_->enter(Mode::joint, 0.0);
  } else if (moves_joint()) {
    other_->rest_now();
  }
}

bool Channel::hand_over(Mode ended) {
  if (other_ == nullptr || !leads_ || !measures(ended) || !axis_.has_found()) return false;
  if (other_->state_.state() != State::armed) return false;
  other_->enter(ended, 0.0);
  handed_over_ = ended;
  return true;
}

void Channel::follow_other() {
  if (other_->state_.may_heat()) return;
  handed_over_ = Mode::rest;
  state_.rest();
}

void Channel::publish_joint(Snapshot& s) const {
  if (other_ == nullptr || !leads_) return;
  if (measures(s.mode)) s.progress *= 0.5F;
  if (!waits_for_other()) return;
  s.mode = handed_over_;
  s.result = ModeResult::running;
  s.progress = 0.5F * (1.0F + other_->snapshot_.progress);
}

void Channel::rest_now() {
  state_.rest();
  axis_.rest();
}

}  // namespace supercoil
