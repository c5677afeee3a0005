// Rows on their way from the loop to the recorder.
#pragma once

#include <atomic>
#include <cstddef>

#include <boost/lockfree/spsc_queue.hpp>

#include "loop/row.hpp"

namespace supercoil::daemon {

/// The telemetry thread takes the loop's rows, looks at them, and puts them here for the storage
/// worker, which may be waiting for a disk: so what the bus and local programs are told is never
/// older than a round of telemetry. Neither side waits; all memory is taken when it is made.
class RowRelay {
 public:
  /// rows: that it holds; what does not fit is lost to the recorder, and counted.
  explicit RowRelay(std::size_t rows) : rows_(rows) {}

  /// The telemetry thread's.
  void put(const Row& row) {
    if (!rows_.push(row)) lost_.fetch_add(1, std::memory_order_relaxed);
  }
  /// The storage worker's.
  bool take(Row& row) { return rows_.pop(row); }
  std::size_t lost() const { return lost_.load(std::memory_order_relaxed); }

 private:
  boost::lockfree::spsc_queue<Row> rows_;
  std::atomic<std::size_t> lost_{0};
};

}  // namespace supercoil::daemon
