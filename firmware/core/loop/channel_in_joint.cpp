// What a channel does with the other one of its joint.
#include "loop/channel.hpp"

namespace supercoil {

bool Channel::moves_joint() const {
  const Mode moving = leads_ ? Mode::position : Mode::joint;
  return other_ != nullptr && state_.may_heat() && axis_.mode() == moving;
}

bool Channel::led() const {
  return !leads_ && moves_joint();
}

/// To follow a position takes both muscles. All else is done by one of them, while the other one is
/// not led; what measures the muscle wants it cold.
Refusal Channel::joint_admits(Mode mode, const BoardTick& board) const {
  if (other_ == nullptr) return Refusal::none;
  const bool other_is_alone = other_->state_.may_heat() && !other_->moves_joint();
  if (mode == Mode::position) {
    if (!leads_) return Refusal::wrong_state;
    return other_is_alone ? Refusal::busy : other_->may_heat(board);
  }
  if (led()) return Refusal::busy;
  return other_is_alone && mode != Mode::power ? Refusal::busy : Refusal::none;
}

void Channel::lead(Mode mode) {
  if (other_ == nullptr || !leads_) return;
  if (mode == Mode::position) {
    if (!moves_joint()) other_->enter(Mode::joint, 0.0);
  } else if (moves_joint()) {
    other_->rest_now();
  }
}

void Channel::rest_now() {
  state_.rest();
  axis_.rest();
}

}  // namespace supercoil
