// Two threads as on a board: one makes rows like the loop, the other records them.
#include <atomic>
#include <thread>

#include <CppUTest/TestHarness.h>
#include <boost/lockfree/spsc_queue.hpp>

#include "loop/loop.hpp"
#include "recorder/pump.hpp"
#include "storage/posix_files.hpp"
#include "unit/firmware/io/recorder/support/recorder_on_a_disk.hpp"
#include "unit/firmware/io/storage/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::test;

/// pump() also compiles with the real loop.
template std::size_t recorder::pump<Loop>(Loop&, recorder::FlightRecorder&, hal::Time);

namespace {

/// The loop's ring, filled as the loop does.
struct Ring {
  boost::lockfree::spsc_queue<Row> rows{400};  // 2 s of two channels
  std::atomic<bool> done{false};

  bool take(Row& row) { return rows.pop(row); }
  void push(const Row& row) {
    while (!rows.push(row))
      std::this_thread::yield();  // the loop would lose the row; here none may be missing
  }
};

}  // namespace

TEST_GROUP(Threads) {
  TemporaryFolder folder;
  storage::PosixFiles files;
  Ring ring;

  recorder::Recording recording(int number) {
    const std::string path = folder.path() + "/flight-" + std::to_string(number) + ".scfr";
    const auto text = files.read(path, 1 << 24);
    CHECK_TEXT(text.has_value(), path.c_str());
    return *recorder::decode(*text, recorder::Damaged::refuse);
  }
};

TEST(Threads, AllRowsArriveInOrderWhileRecordingsAreWritten) {
  constexpr int faults = 6;
  constexpr double apart_s = 20.0;
  std::thread loop([&] {
    for (std::int64_t tick = 0; tick <= static_cast<std::int64_t>(faults * apart_s * rate_Hz);
         ++tick) {
      const std::int64_t in_turn = tick % static_cast<std::int64_t>(apart_s * rate_Hz);
      // The fault comes at 15 s of every 20 s and is reset at their end.
      const Fault fault = in_turn >= 1500 ? Fault::over_travel : Fault::none;
      ring.push(row(tick * tick_ns, 0, fault));
      ring.push(row(tick * tick_ns, 1));
    }
    ring.done = true;
  });
  recorder::FlightRecorder recorder(folder.path(), 2, rate_Hz, files);
  std::size_t count = 0;
  bool done = false;
  while (!done) {
    done = ring.done;  // before the last read of the ring
    count += pump(ring, recorder, hal::Time{});
  }
  loop.join();
  LONGS_EQUAL(2 * (faults * 2000 + 1), count);
  for (int i = 1; i <= faults; ++i) {
    const double at_s = (i - 1) * apart_s + 15.0;
    check_rows(recording(i).rows, at_s - 10.0, at_s + 1.0);
  }
}

TEST(Threads, RowsLostByAFullRingAreAGapAndTheRestIsInOrder) {
  recorder::FlightRecorder recorder(folder.path(), 2, rate_Hz, files);
  std::int64_t lost = 0;
  // The recorder stalls for 3 s: the ring holds 2 s, and the loop goes on.
  for (std::int64_t tick = 0; tick < 1500; ++tick) {
    const Fault fault = tick >= 1300 ? Fault::over_travel : Fault::none;
    for (const int channel : {0, 1}) {
      if (!ring.rows.push(row(tick * tick_ns, channel, fault))) ++lost;
    }
    if (tick < 700 || tick >= 1000) pump(ring, recorder, hal::Time{});
  }
  LONGS_EQUAL(202, lost);  // from 9 s on, and the tick at which the recorder returns
  const auto rows = recording(1).rows;
  LONGS_EQUAL(2L * 1101 - lost, rows.size());
  std::int64_t longest = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    CHECK(rows[i].time_ns >= rows[i - 1].time_ns);
    longest = std::max(longest, rows[i].time_ns - rows[i - 1].time_ns);
  }
  CHECK(longest == std::int64_t{102} * tick_ns);
}
