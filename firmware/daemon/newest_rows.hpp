// The newest row of every channel, for those who do not keep them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal_linux/mailbox.hpp"

#include "loop/row.hpp"

namespace supercoil::daemon {

/// Written by the thread that takes the loop's rows, read by one other.
class NewestRows {
 public:
  explicit NewestRows(std::size_t channels) {
    for (std::size_t i = 0; i < channels; ++i)
      boxes_.push_back(std::make_unique<hal_linux::Mailbox<Row>>());
  }

  /// The writer's.
  void put(const Row& row) {
    if (row.channel < boxes_.size()) boxes_[row.channel]->put(row);
  }
  /// The reader's: a line for each channel,
  /// "1 active position none 0.012 0.0118 0.0119 1.25 66.1 78.2 0.5": channel, state, mode, fault,
  /// reference, reference model and position in m, applied power in W, coldest and hottest in °C,
  /// progress.
  std::string describe();

 private:
  std::vector<std::unique_ptr<hal_linux::Mailbox<Row>>> boxes_;
};

}  // namespace supercoil::daemon
