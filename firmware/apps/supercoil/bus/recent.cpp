#include "apps/supercoil/bus/recent.hpp"

#include <algorithm>

#include "can/codec.hpp"
#include "telemetry/schedule.hpp"

namespace supercoil::operating {

namespace {

/// A day of one board; applies whatever keep_s is.
constexpr std::size_t max_frames = 40'000'000;

bool earlier(const hal::CanFrame& frame, hal::Time time) {
  return frame.received < time;
}

}  // namespace

void FrameHistory::add(const std::vector<hal::CanFrame>& frames) {
  const std::lock_guard lock(mutex_);
  for (const hal::CanFrame& frame : frames) {
    if (keep_.count() > 0 && !frames_.empty() &&
        is_restart(frames_.back().received, frame.received)) {
      dropped_ += frames_.size();
      frames_.clear();
    }
    frames_.push_back(frame);
    // Times never decrease: a frame that comes out of order is not earlier than the last.
    if (frames_.size() > 1) {
      hal::CanFrame& newest = frames_.back();
      newest.received = std::max(newest.received, frames_[frames_.size() - 2].received);
    }
    const auto decoded = can::decode(frame);
    if (!decoded) continue;
    if (!decoded->message->to_node) nodes_ |= std::uint64_t{1} << decoded->node;
    if (decoded->message->name == "Emergency") first_causes_.erase(decoded->node);
    if (decoded->message->name == "FirstCause") first_causes_[decoded->node] = frame;
  }
  const auto old = [&] {
    const bool out =
        keep_.count() > 0 && frames_.back().received - frames_.front().received > keep_;
    return out || frames_.size() > max_frames;
  };
  while (!frames_.empty() && old()) {
    frames_.pop_front();
    ++dropped_;
  }
}

std::optional<hal::CanFrame> FrameHistory::first_cause(std::uint8_t node) const {
  const std::lock_guard lock(mutex_);
  const auto found = first_causes_.find(node);
  return found == first_causes_.end() ? std::nullopt : std::optional(found->second);
}

FrameHistory::Part FrameHistory::since(std::uint64_t from) const {
  const std::lock_guard lock(mutex_);
  Part part;
  part.next = dropped_ + frames_.size();
  const std::uint64_t first = std::clamp(from, dropped_, part.next) - dropped_;
  part.frames.assign(frames_.begin() + static_cast<std::ptrdiff_t>(first), frames_.end());
  return part;
}

std::uint64_t FrameHistory::end() const {
  const std::lock_guard lock(mutex_);
  return dropped_ + frames_.size();
}

std::vector<hal::CanFrame> FrameHistory::between(hal::Time from, hal::Time to) const {
  const std::lock_guard lock(mutex_);
  if (frames_.empty()) return {};
  if (from.count() < 0) from += frames_.back().received;
  const auto first = std::lower_bound(frames_.begin(), frames_.end(), from, earlier);
  const auto last =
      to == hal::Time::max() ? frames_.end() : std::lower_bound(first, frames_.end(), to, earlier);
  return {first, std::max(first, last)};
}

BusFigures FrameHistory::figures() const {
  const std::lock_guard lock(mutex_);
  BusFigures figures;
  if (frames_.empty() || !lost_.empty()) return figures;
  const hal::Time from = frames_.back().received - std::chrono::seconds(1);
  for (auto frame = frames_.rbegin(); frame != frames_.rend() && frame->received > from; ++frame) {
    figures.load += telemetry::max_bits(frame->length) / bit_rate_;
    figures.frames_per_s += 1.0;
    if (!can::decode(*frame)) figures.foreign_per_s += 1.0;
  }
  return figures;
}

std::vector<std::uint8_t> FrameHistory::nodes() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::uint8_t> nodes;
  for (std::uint8_t node = 1; node < 64; ++node) {
    if ((nodes_ >> node & 1U) != 0) nodes.push_back(node);
  }
  return nodes;
}

void FrameHistory::set_lost(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  lost_ = reason;
}

std::string FrameHistory::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

}  // namespace supercoil::operating
