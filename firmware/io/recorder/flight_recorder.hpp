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

struct RecorderSettings {
  double before_s = 10.0;  ///< how much of a recording lies before the fault,
  double after_s = 1.0;    ///< and how much after it
  double retry_s = 5.0;    ///< after a failure, until the second and last try
  std::size_t most = 20;   ///< recordings in the folder; 1 or more
  ListFolder list = list_folder;
};

/// For the log: what became of a recording.
struct RecorderNote {
  bool problem;
  std::string text;  ///< "/…/flight-3.scfr: over_temperature (30) of channel 2 is recorded"
};

/// A plain object, used by one thread that may block: not the loop's. Writing a recording blocks
/// add(), poll() or finish() for as long as the disk takes; the loop's ring holds the rows for 1 s
/// meanwhile, and rows that it loses are a gap in the times.
class FlightRecorder {
 public:
  /// channels: 1 to 16; rate_Hz > 0. All memory for rows is taken, and touched, here: before_s +
  /// after_s + retry_s of them, so that the second try is as complete as the first would have been.
  /// Touches no file: a folder that is not there is reported when there is something to write.
  FlightRecorder(std::string folder, int channels, double rate_Hz, storage::Files& files,
                 const RecorderSettings& settings = {});

  /// The next row; times must not go back. Writes what is due by its time, else does not allocate.
  /// Rows of channels that there are not are ignored.
  void add(const Row& row);
  /// Writes what is due although no rows arrive any more: the loop stands still. Call it after all
  /// rows up to `now` that have arrived were added.
  void poll(hal::Time now);
  /// Writes at once what would become due later: the process is about to end.
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
    std::string_view first;   ///< rows as bytes, in order of time,
    std::string_view second;  ///< which go on here where the memory begins anew
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
