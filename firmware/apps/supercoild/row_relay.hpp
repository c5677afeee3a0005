// Rows on their way from the loop to the recorder.
#pragma once

#include <atomic>
#include <cstddef>

#include <boost/lockfree/spsc_queue.hpp>

#include "loop/row.hpp"

namespace supercoil::daemon {

/// The telemetry thread takes the loop's rows, looks at them, and puts them here for the storage
/// worker, which may be waiting for a disk. So the bus and local programs never get data older than
/// a round of telemetry. Neither side waits; all memory is allocated in the constructor.
class RowRelay {
 public:
  /// rows: capacity. Rows that do not fit are lost to the recorder, and counted.
  explicit RowRelay(std::size_t rows) : rows_(rows) {}

  /// Called by the telemetry thread.
  void put(const Row& row) {
    if (!rows_.push(row)) lost_.fetch_add(1, std::memory_order_relaxed);
  }
  /// Called by the storage worker.
  bool take(Row& row) { return rows_.pop(row); }
  std::size_t lost() const { return lost_.load(std::memory_order_relaxed); }

 private:
  boost::lockfree::spsc_queue<Row> rows_;
  std::atomic<std::size_t> lost_{0};
};

}  // namespace supercoil::daemon
