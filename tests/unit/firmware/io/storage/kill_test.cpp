// The store on real files, while its process is killed.
#include <cstring>
#include <random>
#include <string>

#include <CppUTest/TestHarness.h>

#include "storage/posix_files.hpp"
#include "storage/store.hpp"
#include "unit/firmware/io/storage/support/child.hpp"
#include "unit/firmware/io/storage/support/deadly_files.hpp"
#include "unit/firmware/io/storage/support/sets.hpp"
#include "unit/firmware/io/storage/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::storage;
using namespace supercoil::test;

TEST_GROUP(Kill) {
  TemporaryFolder folder;
  PosixFiles files;

  /// The stored set, which must exist and be valid.
  board::Learned stored() {
    const auto loaded = LearnedStore(folder.path(), 1, files).load();
    CHECK_TEXT(loaded.has_value(), loaded ? "" : loaded.error().text().c_str());
    CHECK(loaded->learned.has_value());
    CHECK_TEXT(loaded->problems.empty(), "nothing is damaged");
    CHECK_TEXT(which(*loaded->learned) >= 0, "the set is one that was saved, whole");
    return *loaded->learned;
  }
};

TEST(Kill, BeforeAndAfterEveryCallLeavesTheOldSetOrTheNewOne) {
  CHECK(LearnedStore(folder.path(), 1, files).save(nth_set(1)).has_value());
  CHECK(LearnedStore(folder.path(), 1, files).save(nth_set(2)).has_value());
  int kills = 0;
  for (int step = 0;; ++step) {
    const int before = which(stored());
    const int next = before + 1;
    Child child([&](int) {
      DeadlyFiles deadly(step);
      static_cast<void>(LearnedStore(folder.path(), 1, deadly).save(nth_set(next)));
    });
    const int status = child.end(0);
    const int now = which(stored());
    CHECK(now == before || now == next);
    if (!WIFSIGNALED(status)) {
      LONGS_EQUAL(next, now);
      break;
    }
    ++kills;
  }
  LONGS_EQUAL(22, kills);  // ten calls, and the write in two parts
}

TEST(Kill, AtRandomMomentsLosesNothingReportedAsSaved) {
  std::mt19937 random(20261120);
  CHECK(LearnedStore(folder.path(), 1, files).save(nth_set(0)).has_value());
  std::uint32_t last = stored().version;
  for (int i = 0; i < 300; ++i) {
    Child child([&](int report) {
      LearnedStore store(folder.path(), 1, files);
      for (int n = i;; ++n) {
        const auto version = store.save(nth_set(n % 1000));
        if (!version || write(report, &*version, sizeof *version) < 0) _exit(1);
      }
    });
    static_cast<void>(child.read(sizeof last));  // by now it is busy saving
    usleep(static_cast<useconds_t>(random() % 3000));
    CHECK(WIFSIGNALED(child.end(SIGKILL)));
    std::string reported = child.read(1 << 16);
    if (reported.size() >= sizeof last) {
      std::memcpy(&last, reported.data() + reported.size() - sizeof last, sizeof last);
    }
    CHECK(stored().version >= last);
    last = stored().version;
  }
}
