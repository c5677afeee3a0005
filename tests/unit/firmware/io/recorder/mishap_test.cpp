// Every call on files fails once or for good, or the power goes or the process dies at it.
#include <cerrno>
#include <filesystem>
#include <string>

#include <sys/resource.h>

#include <CppUTest/TestHarness.h>

#include "storage/posix_files.hpp"
#include "unit/firmware/io/recorder/support/recorder_on_a_disk.hpp"
#include "unit/firmware/io/storage/support/child.hpp"
#include "unit/firmware/io/storage/support/deadly_files.hpp"
#include "unit/firmware/io/storage/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::test;
using recorder::FlightRecorder;

namespace {

constexpr int calls_of_a_recording = 9;

/// Two recordings, of two that may be kept, and an interrupted one.
Content start() {
  std::vector<Row> rows{row(5 * second_ns, 1, Fault::over_temperature)};
  const std::string whole = file_of(rows);
  return {{"/d/flight-4.scfr", whole},
          {"/d/flight-5.scfr", whole},
          {"/d/flight-6.scfr.new", whole.substr(0, 550)}};
}

recorder::RecorderSettings two(const Disk& disk) {
  recorder::RecorderSettings settings = settings_on(disk);
  settings.max_recordings = 2;
  return settings;
}

/// Everything that looks like a recording is complete; returns how many there are.
int whole_recordings(const Content& content) {
  int count = 0;
  for (const auto& [path, text] : content) {
    if (!path.ends_with(".scfr")) continue;
    CHECK_TEXT(recorder::decode(text, recorder::Damaged::refuse).has_value(), path.c_str());
    ++count;
  }
  return count;
}

}  // namespace

TEST_GROUP(Mishap) {
  TemporaryFolder folder;
  storage::PosixFiles real;

  Content content() {
    Content found;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      found[entry.path().string()] = *real.read(entry.path().string(), 1 << 24);
    return found;
  }
};

TEST(Mishap, CountsTheCalls) {
  Disk disk(start());
  SimulatedFiles files(disk);
  FlightRecorder recorder("/d", 2, rate_Hz, files, two(disk));
  Ticks{recorder, 0, {Fault::over_travel, Fault::none}}.until(2.0);
  // Two removed, one made, header, rows in one piece, synced, closed, renamed, folder synced.
  LONGS_EQUAL(calls_of_a_recording, files.calls());
}

TEST(Mishap, ACallThatFailsOnceOrForeverLeavesWholeRecordings) {
  for (int call = 0; call < calls_of_a_recording; ++call) {
    for (const bool for_good : {false, true}) {
      for (const bool takes_effect : {false, true}) {
        Disk disk(start());
        SimulatedFiles files(disk, {call, EIO, for_good, takes_effect});
        FlightRecorder recorder("/d", 2, rate_Hz, files, two(disk));
        Ticks ticks{recorder, 0, {Fault::over_travel, Fault::none}};
        ticks.until(10.0);
        const int there = whole_recordings(disk.seen());
        CHECK_TEXT(there >= 1, "what there was before goes only to make room");
        if (for_good) continue;
        CHECK_TEXT(
            disk.names.contains("/d/flight-6.scfr") || disk.names.contains("/d/flight-7.scfr"),
            "the second try succeeds");
        ticks.reset();
        ticks.until(11.0);
        ticks.fault(1);
        ticks.until(20.0);
        CHECK_TEXT(whole_recordings(disk.seen()) <= 2, "the next recording tidies up");
        LONGS_EQUAL(disk.names.size(), whole_recordings(disk.seen()));
      }
    }
  }
}

TEST(Mishap, APowerCutAtAnyCallLeavesWholeRecordings) {
  for (int call = 0; call < calls_of_a_recording; ++call) {
    for (const bool takes_effect : {false, true}) {
      Disk disk(start());
      SimulatedFiles files(disk, {call, 0, true, takes_effect});
      FlightRecorder recorder("/d", 2, rate_Hz, files, two(disk));
      Ticks{recorder, 0, {Fault::over_travel, Fault::none}}.until(1.1);
      for (const Content& left : disk.survivors()) {
        CHECK_TEXT(whole_recordings(left) >= 1, "the newer of the old ones stays");
        Disk again(left);
        SimulatedFiles healthy(again);
        FlightRecorder next("/d", 2, rate_Hz, healthy, two(again));
        Ticks{next, 0, {Fault::over_travel, Fault::none}}.until(1.1);
        LONGS_EQUAL(2, whole_recordings(again.seen()));
        LONGS_EQUAL(2, again.names.size());
      }
    }
  }
}

TEST(Mishap, KilledBeforeAndAfterEveryCallLeavesWholeRecordings) {
  for (int step = 0;; ++step) {
    Child child([&](int) {
      DeadlyFiles deadly(step);
      FlightRecorder recorder(folder.path(), 2, rate_Hz, deadly);
      Ticks{recorder, 0, {Fault::over_travel, Fault::none}}.until(1.1);
    });
    const bool killed = WIFSIGNALED(child.end(0));
    whole_recordings(content());
    if (killed) continue;
    // With the last killed run's leftovers: made, four partial writes, synced, closed, renamed.
    CHECK(step >= 18);
    for (const auto& [path, text] : content())
      CHECK_TEXT(path.ends_with(".scfr"), path.c_str());
    break;
  }
}

TEST(Mishap, AFileTooLargeForTheFileSystemIsReported) {
  Child child([&](int report) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit small{10'000, 10'000};
    setrlimit(RLIMIT_FSIZE, &small);
    FlightRecorder recorder(folder.path(), 2, rate_Hz, real);
    Ticks{recorder, 0, {Fault::over_travel, Fault::none}}.until(2.0);
    for (const auto& note : recorder.take_notes())
      static_cast<void>(!write(report, note.text.data(), note.text.size()));
  });
  STRCMP_EQUAL(("over_travel (31) of channel 1 is not recorded: " + folder.path() +
                "/flight-1.scfr.new: cannot be written: File too large; will try once more")
                   .c_str(),
               child.read(1000).c_str());
  LONGS_EQUAL(0, content().size());
}

TEST(Mishap, AFolderThatReappearsInTimeGetsTheRecording) {
  const std::string later = folder.path() + "/mounted";
  FlightRecorder recorder(later, 2, rate_Hz, real);
  Ticks ticks{recorder, 0, {Fault::over_travel, Fault::none}};
  ticks.until(2.0);
  std::filesystem::create_directory(later);
  ticks.until(7.0);
  CHECK(std::filesystem::exists(later + "/flight-1.scfr"));
}
