// Commands that were handed to the loop, until it has answered them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>

namespace supercoil::telemetry {

/// Header: as much of a frame as its answer repeats.
template <class Header>
class Unanswered {
 public:
  bool full() const { return waiting_.size() == max_waiting; }
  /// Not while it is full. Gives the id by which the answer is known.
  std::uint32_t add(const Header& header) {
    waiting_.push_back({++last_id_, header});
    return last_id_;
  }
  /// The loop did not take the last one that was added.
  Header take_back() {
    const Header header = waiting_.back().header;
    waiting_.pop_back();
    return header;
  }
  /// Empty: it is not waited for. The loop answers in order: what was added before it, and is not
  /// answered, is no longer waited for.
  std::optional<Header> answered(std::uint32_t id) {
    const auto found = std::ranges::find(waiting_, id, &Waiting::id);
    if (found == waiting_.end()) return std::nullopt;
    const Header header = found->header;
    waiting_.erase(waiting_.begin(), found + 1);
    return header;
  }

 private:
  /// What the loop's ring of commands holds.
  static constexpr std::size_t max_waiting = 256;

  struct Waiting {
    std::uint32_t id;
    Header header;
  };
  std::deque<Waiting> waiting_;  ///< in the order of their ids
  std::uint32_t last_id_ = 0;
};

}  // namespace supercoil::telemetry
