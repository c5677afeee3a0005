// Commands that were passed to the loop and are not answered yet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>

namespace supercoil::telemetry {

/// Header: the part of a frame that its answer repeats.
template <class Header>
class Unanswered {
 public:
  bool full() const { return waiting_.size() == max_waiting; }
  /// Not while it is full. Returns the id that the answer will carry.
  std::uint32_t add(const Header& header) {
    waiting_.push_back({++last_id_, header});
    return last_id_;
  }
  /// Removes the last one that was added, because the loop did not take it.
  Header take_back() {
    const Header header = waiting_.back().header;
    waiting_.pop_back();
    return header;
  }
  /// Empty: nothing waits for this id. The loop answers in order, so what was added earlier and has
  /// no answer is given up.
  std::optional<Header> answered(std::uint32_t id) {
    const auto found = std::ranges::find(waiting_, id, &Waiting::id);
    if (found == waiting_.end()) return std::nullopt;
    const Header header = found->header;
    waiting_.erase(waiting_.begin(), found + 1);
    return header;
  }

 private:
  /// The capacity of the loop's command ring.
  static constexpr std::size_t max_waiting = 256;

  struct Waiting {
    std::uint32_t id;
    Header header;
  };
  std::deque<Waiting> waiting_;  ///< in the order of their ids
  std::uint32_t last_id_ = 0;
};

}  // namespace supercoil::telemetry
