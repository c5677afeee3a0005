// How a channel acts with the others of its joint or bundle.
#include <utility>

#include "loop/channel.hpp"

namespace supercoil {

void Channel::lead_joint(Channel& antagonist) {
  others_ = {&antagonist};
  antagonist.others_ = {this};
  antagonist.leader_ = this;
}

void Channel::lead_bundle(std::vector<Channel*> followers) {
  bundled_ = true;
  for (Channel* const follower : followers) {
    follower->bundled_ = true;
    follower->leader_ = this;
    follower->others_ = {this};
    for (Channel* const other : followers) {
      if (other != follower) follower->others_.push_back(other);
    }
  }
  others_ = std::move(followers);
}

/// The two muscles of a joint may also be driven separately; those of a bundle all get one power,
/// and only rest or calibrate alone.
bool Channel::takes_all(Mode mode) const {
  if (!bundled_) return mode == Mode::position;
  return mode != Mode::rest && mode != Mode::calibrate;
}

/// Identify moves a whole bundle at once, so that only calibrate is handed over.
bool Channel::is_handed_over(Mode mode) const {
  return bundled_ ? mode == Mode::calibrate : measures(mode);
}

bool Channel::moves_together() const {
  if (others_.empty() || !state_.may_heat()) return false;
  return leader_ == nullptr ? takes_all(axis_.mode()) : is_led(axis_.mode());
}

bool Channel::led() const {
  return leader_ != nullptr && (moves_together() || leader_->waits_for_others());
}

Refusal Channel::group_admits(Mode mode, const BoardTick& board) const {
  if (others_.empty()) return Refusal::none;
  if (waits_for_others()) return Refusal::busy;
  return bundled_ ? bundle_admits(board) : joint_admits(mode, board);
}

/// Following a position takes both muscles. Every other mode takes one of them while the other is
/// not led; a mode that measures needs the other one cold.
Refusal Channel::joint_admits(Mode mode, const BoardTick& board) const {
  const Channel& other = *others_.front();
  const bool other_is_alone = other.state_.may_heat() && !other.moves_together();
  if (mode == Mode::position) {
    if (leader_ != nullptr) return Refusal::wrong_state;
    return other_is_alone ? Refusal::busy : other.may_heat(board);
  }
  if (led()) return Refusal::busy;
  const bool disturbs = mode != Mode::power || measures(other.axis_.mode());
  return other_is_alone && disturbs ? Refusal::busy : Refusal::none;
}

Refusal Channel::bundle_admits(const BoardTick& board) const {
  if (leader_ != nullptr) return Refusal::wrong_state;
  for (const Channel* const other : others_) {
    if (const Refusal others = other->may_heat(board); others != Refusal::none) return others;
  }
  return Refusal::none;
}

void Channel::lead(Mode mode) {
  if (leader_ != nullptr) return;
  const bool moves = moves_together();
  for (Channel* const other : others_) {
    if (takes_all(mode)) {
      if (!moves) other->enter(bundled_ ? Mode::bundle : Mode::joint, 0.0);
    } else if (moves) {
      other->rest_now();
    }
  }
}

bool Channel::hand_over(Mode ended) {
  if (leader_ != nullptr || !is_handed_over(ended) || !axis_.has_found()) return false;
  return hand_over_to(0, ended);
}

bool Channel::hand_over_to(std::size_t place, Mode mode) {
  if (place >= others_.size() || others_[place]->state_.state() != State::armed) return false;
  // Now: it may run in this tick before it would take over the knowledge by itself.
  if (bundled_) others_[place]->axis_.follow_knowledge(axis_);
  others_[place]->enter(mode, 0.0);
  handed_over_ = mode;
  handed_over_to_ = place;
  return true;
}

void Channel::follow_others() {
  const Channel& other = *others_[handed_over_to_];
  if (other.state_.may_heat()) return;
  const std::size_t next = handed_over_to_ + 1;
  // A result other than `found` stands, however the others end.
  if (bundled_ && other.axis_.result() != ModeResult::found) axis_.conclude(other.axis_.result());
  if (other.axis_.has_found()) {
    if (hand_over_to(next, handed_over_)) return;
    if (bundled_ && next < others_.size()) axis_.conclude(ModeResult::interrupted);
  }
  handed_over_ = Mode::rest;
  state_.rest();
}

void Channel::abandon_others() {
  if (bundled_ && waits_for_others()) axis_.conclude(ModeResult::interrupted);
  handed_over_ = Mode::rest;
}

void Channel::publish_group(Snapshot& s) const {
  if (others_.empty() || leader_ != nullptr) return;
  const float share = 1.0F / static_cast<float>(1 + others_.size());
  if (is_handed_over(s.mode)) s.progress *= share;
  if (!waits_for_others()) return;
  s.mode = handed_over_;
  s.result = ModeResult::running;
  const auto done = static_cast<float>(1 + handed_over_to_);
  s.progress = share * (done + others_[handed_over_to_]->snapshot_.progress);
}

void Channel::rest_now() {
  state_.rest();
  axis_.rest();
}

}  // namespace supercoil
