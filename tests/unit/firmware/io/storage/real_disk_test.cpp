// The store in real folders where it may not write.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <sys/stat.h>

#include <CppUTest/TestHarness.h>

#include "storage/posix_files.hpp"
#include "storage/store.hpp"
#include "unit/firmware/io/storage/support/child.hpp"
#include "unit/firmware/io/storage/support/sets.hpp"
#include "unit/firmware/io/storage/support/temporary_folder.hpp"

using namespace supercoil::storage;
using namespace supercoil::test;
namespace fs = std::filesystem;

TEST_GROUP(RealDisk) {
  TemporaryFolder folder;
  PosixFiles files;
  LearnedStore store{folder.path(), 2, files};

  std::string file(const std::string& ending = "") const {
    return folder.path() + "/learned-2.toml" + ending;
  }
  /// The result of a save in a process prepared in this way.
  template <class Preparation>
  std::string saved_after(Preparation preparation) {
    Child child([&](int answer) {
      preparation();
      const auto saved = store.save(nth_set(7));
      const std::string text = saved ? "saved" : saved.error().text();
      if (write(answer, text.data(), text.size()) < 0) _exit(1);
    });
    return child.read(1 << 12);
  }
  int loaded() {
    return which(*store.load()->learned);
  }
};

TEST(RealDisk, KeepsTheOldSetWhenTheDiskIsFull) {
  CHECK(store.save(nth_set(1)).has_value());
  const std::string answer = saved_after([] {
    // Files are limited to 100 bytes: the first write is cut short, the next one fails.
    static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
    const rlimit small{100, 100};
    setrlimit(RLIMIT_FSIZE, &small);
  });
  STRCMP_EQUAL((file(".new") + ": cannot be written: File too large").c_str(), answer.c_str());
  CHECK_FALSE(fs::exists(file(".new")));
  LONGS_EQUAL(1, loaded());
}

TEST(RealDisk, KeepsTheOldSetWhenNoFileCanBeOpened) {
  CHECK(store.save(nth_set(1)).has_value());
  const std::string answer = saved_after([] {
    const rlimit no_more{0, 0};
    setrlimit(RLIMIT_NOFILE, &no_more);
  });
  STRCMP_EQUAL((file(".new") + ": cannot be created: Too many open files").c_str(), answer.c_str());
  LONGS_EQUAL(1, loaded());
}

TEST(RealDisk, ReportsAReadOnlyFolderAndStillLoads) {
  CHECK(store.save(nth_set(1)).has_value());
  chmod(folder.path().c_str(), 0555);
  const std::string answer = saved_after([] {
    // Root may write regardless of the mode.
    constexpr uid_t nobody = 65534;
    if (geteuid() == 0 && setuid(nobody) != 0) _exit(1);
  });
  STRCMP_EQUAL((file(".new") + ": cannot be created: Permission denied").c_str(), answer.c_str());
  LONGS_EQUAL(1, loaded());
  chmod(folder.path().c_str(), 0755);
}

TEST(RealDisk, ReportsAMissingFolder) {
  const std::string gone = folder.path() + "/gone";
  LearnedStore lost(gone, 2, files);
  const auto loaded_there = lost.load();
  CHECK_FALSE(loaded_there.has_value());
  STRCMP_EQUAL((gone + ": cannot be opened as a folder: No such file or directory").c_str(),
               loaded_there.error().text().c_str());
  const auto saved = lost.save(nth_set(1));
  CHECK_FALSE(saved.has_value());
  STRCMP_EQUAL((gone + "/learned-2.toml.new: cannot be created: No such file or directory").c_str(),
               saved.error().text().c_str());
}

TEST(RealDisk, DamagedTruncatedAndEmptyFilesGiveThePreviousSet) {
  CHECK(store.save(nth_set(1)).has_value());
  CHECK(store.save(nth_set(2)).has_value());
  const std::string good = *files.read(file(), 9999);
  std::string damaged = good;
  damaged[200] ^= 4;
  for (const std::string& bad :
       {std::string(), good.substr(0, 300), damaged, std::string(good.size(), '\0'), good + good,
        std::string(100000, 'x')}) {
    std::ofstream(file(), std::ios::binary) << bad;
    LONGS_EQUAL(1, loaded());
    CHECK(store.load()->source == Source::previous);
  }
}

TEST(RealDisk, AFolderInTheFilesPlaceIsDamageAndIsKept) {
  CHECK(store.save(nth_set(1)).has_value());
  CHECK(store.save(nth_set(2)).has_value());
  fs::remove(file());
  fs::create_directory(file());
  LONGS_EQUAL(1, loaded());
  CHECK_FALSE(store.save(nth_set(3)).has_value());
  CHECK(fs::is_directory(file()));
  LONGS_EQUAL(1, loaded());
}

TEST(RealDisk, KeepsItsFilesReadableByAll) {
  CHECK(store.save(nth_set(1)).has_value());
  CHECK(store.save(nth_set(2)).has_value());
  for (const std::string& name : {file(), file(".previous")}) {
    struct stat status {};
    LONGS_EQUAL(0, stat(name.c_str(), &status));
    LONGS_EQUAL(0444, status.st_mode & 0444);
  }
}
