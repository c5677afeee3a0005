// The thread that may wait for the disk: recordings, learned sets, and the log.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/supercoild/row_relay.hpp"
#include "config/board_config.hpp"
#include "loop/loop.hpp"
#include "recorder/flight_recorder.hpp"
#include "storage/posix_files.hpp"
#include "storage/store.hpp"

namespace supercoil::daemon {

/// Applies what channels learned before to the settings of a board whose storage worker is made
/// afterwards. The error says what cannot be read. A board does not start without what it had
/// learned, because a lost zero is a wrong position.
Result<void> load_learned(config::BoardConfig& config, std::vector<storage::LearnedStore>& stores);

/// The one thread that may wait for the disk. Its resources are allocated in the constructor,
/// before memory is locked.
class StorageWorker {
 public:
  /// Both outlive it.
  StorageWorker(const config::BoardConfig& config, std::vector<storage::LearnedStore>& stores,
                storage::Files& files);

  /// Takes what has arrived through the relay. now: on the loop's clock, read before the call.
  void poll(Loop& loop, hal::Time now);
  /// Writes everything that is pending.
  void finish();

  RowRelay& relay() { return relay_; }
  /// How many rows have arrived: a live loop makes them.
  std::uint64_t rows() const { return rows_; }
  /// Whether no channel is armed or active, by the rows so far.
  bool all_off() const;

 private:
  void watch(const Row& row);
  void store_learned(Loop& loop, std::size_t channel);
  void forget(std::size_t channel, const std::string& label);
  void set_comparison_date(std::size_t channel, const std::string& label,
                           board::SenseComparison& senses);
  void log_notes();
  static void report_lost(std::size_t lost, std::size_t& reported, const char* why);

  const config::BoardConfig* config_;
  std::vector<storage::LearnedStore>* stores_;
  recorder::FlightRecorder recorder_;
  RowRelay relay_;
  std::size_t reported_lost_by_disk_ = 0;
  std::size_t reported_lost_by_loop_ = 0;
  std::vector<board::SenseComparison> senses_;  ///< in use by each channel
  std::vector<Row> last_;                       ///< of each channel
  std::uint64_t rows_ = 0;
};

}  // namespace supercoil::daemon
