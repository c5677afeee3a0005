// The newest row of every channel.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "loop/loop.hpp"
#include "loop/row.hpp"

namespace supercoil::daemon {

/// Used by one thread.
class NewestRows {
 public:
  explicit NewestRows(std::size_t channels) : rows_(channels) {}

  void put(const Row& row) {
    if (row.channel < rows_.size()) rows_[row.channel] = row;
    newest_s_ = 1e-9 * static_cast<double>(row.time_ns);
  }
  /// The board's time at the newest tick.
  double newest_s() const { return newest_s_; }
  /// A line for each channel, with the words that state_words.hpp names:
  /// "1 active position none 0.012 0.0118 0.0119 1.25 66.1 78.2 0.5 none - 0 mrac". The result is a
  /// ModeResult, the notes are IdentifyNotes. loop: gives the controllers' kinds.
  std::string describe(const Loop& loop) const;
  /// A line for each channel, "1 armed none probing": channel, state, fault, and whether its heater
  /// is being measured ("-" if not).
  std::string describe_status() const;

 private:
  std::vector<Row> rows_;
  double newest_s_ = 0.0;
};

}  // namespace supercoil::daemon
