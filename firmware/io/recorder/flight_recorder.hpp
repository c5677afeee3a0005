// Keeps the last seconds of every tick, and writes them to a file when a fault latches.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "supercoil/hal/clock.hpp"

#include "loop/row.hpp"
#include "recorder/recording_folder.hpp"
#include "storage/files.hpp"

namespace supercoil::recorder {

/// How long recordings are, and how many are kept.
struct RecorderSettings {
  double before_s = 10.0;           ///< how much of a recording lies before the fault,
  double after_s = 1.0;             ///< and how much after it
  double retry_s = 5.0;             ///< after a failure, until the second and last try
  std::size_t max_recordings = 20;  ///< in the folder; 1 or more
  ListFolder list = list_folder;
};

/// For the log: what became of a recording.
struct RecorderNote {
  bool problem;
  std::string text;  ///< "/…/flight-3.scfr: over_temperature (30) of channel 2 is recorded"
};

/// Used by one thread that may block, so not the loop's. Writing a recording blocks add(), poll()
/// or finish() for as long as the disk takes. Meanwhile the loop's ring holds rows for 1 s; rows
/// that it loses leave a gap in the times.
class FlightRecorder {
 public:
  /// channels: 1 to 16; rate_Hz > 0. Allocates and touches all memory for rows, before_s + after_s
  /// + retry_s of them, so that the second try is as complete as the first would have been. Touches
  /// no file: a missing folder is reported when there is something to write.
  FlightRecorder(std::string folder, int channels, double rate_Hz, storage::Files& files,
                 const RecorderSettings& settings = {});

  /// Adds the next row; times must not go back. Writes recordings that are due at its time;
  /// otherwise does not allocate. Ignores rows of channels that do not exist.
  void add(const Row& row);
  /// Writes recordings that are due although the loop has stopped and no rows arrive. Call it after
  /// all rows up to `now` that have arrived were added.
  void poll(hal::Time now);
  /// Writes at once every recording that would be due later: the process is about to end.
  void finish();
  /// What happened since the last call; at most the latest 32.
  std::vector<RecorderNote> take_notes() { return std::exchange(notes_, {}); }

 private:
  /// A recording that is being collected, or waits for its second try.
  struct Job {
    Row cause;
    std::int64_t due_ns;  ///< it is written when this has passed
    bool again;
  };
  struct Window {
    std::string_view first;   ///< rows as bytes, in order of time
    std::string_view second;  ///< the rest of them, from where the ring wraps around
  };

  void watch(const Row& row);
  void write_due(std::int64_t now_ns);
  /// False when it could not be written and another try may help.
  bool write(const Job& job, bool last_try);
  Window window(std::int64_t from_ns, std::int64_t until_ns) const;
  const Row& oldest(std::size_t i) const;
  void note(bool problem, std::string text);

  std::int64_t before_ns_, after_ns_, retry_ns_;
  double rate_Hz_;
  RecordingFolder folder_;
  std::vector<Row> rows_;
  std::size_t next_ = 0;  ///< where the next row goes
  std::size_t size_ = 0;
  std::vector<std::uint8_t> faults_;  ///< of each channel, in its last row
  std::vector<Job> jobs_;
  std::vector<RecorderNote> notes_;
};

}  // namespace supercoil::recorder
