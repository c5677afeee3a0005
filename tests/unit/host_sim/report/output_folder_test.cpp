#include "report/output_folder.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/resource.h>

#include <CppUTest/TestHarness.h>

#include "unit/host_sim/support/content.hpp"

namespace fs = std::filesystem;
using supercoil::host_sim::OutputFolder;
using supercoil::test::content;

namespace {

/// During its lifetime no file can grow beyond this size, as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit small{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &old_);
    static_cast<void>(std::signal(SIGXFSZ, old_handler_));
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  SmallDisk(SmallDisk&&) = delete;
  SmallDisk& operator=(SmallDisk&&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

}  // namespace

TEST_GROUP(OutputFolder) {
  fs::path parent;
  void setup() override {
    std::string name = (fs::temp_directory_path() / "supercoil-test-XXXXXX").string();
    CHECK(mkdtemp(name.data()) != nullptr);
    parent = name;
  }
  void teardown() override {
    fs::remove_all(parent);
  }
};

TEST(OutputFolder, PublishesItsFilesOnlyWhenAllAreComplete) {
  auto folder = OutputFolder::open(parent / "a" / "b");
  CHECK(folder.has_value());
  CHECK(folder->write("one.txt", "1").has_value());
  CHECK_FALSE(fs::exists(parent / "a" / "b" / "one.txt"));
  CHECK(folder->commit().has_value());
  STRCMP_EQUAL("1", content(parent / "a" / "b" / "one.txt").c_str());
}

TEST(OutputFolder, SupersededFilesStayUntilTheRunIsComplete) {
  for (const bool completes : {false, true}) {
    std::ofstream(parent / "old.txt") << "0";
    auto folder = OutputFolder::open(parent);
    folder->supersede("old.txt");
    folder->supersede("never.txt");
    CHECK(fs::exists(parent / "old.txt"));
    if (completes) CHECK(folder->commit().has_value());
    CHECK_EQUAL(!completes, fs::exists(parent / "old.txt"));
  }
}

TEST(OutputFolder, LeavesNothingWhenAbandoned) {
  {
    auto folder = OutputFolder::open(parent / "given-up");
    CHECK(folder->write("one.txt", "1").has_value());
  }
  CHECK_FALSE(fs::exists(parent / "given-up"));
}

TEST(OutputFolder, KeepsAnEarlierRunsFilesWhenAbandoned) {
  std::ofstream(parent / "one.txt") << "earlier";
  {
    auto folder = OutputFolder::open(parent);
    CHECK(folder->write("one.txt", "later").has_value());
  }
  STRCMP_EQUAL("earlier", content(parent / "one.txt").c_str());
  LONGS_EQUAL(1, std::distance(fs::directory_iterator(parent), fs::directory_iterator()));
}

TEST(OutputFolder, ReportsAFullDiskAndLeavesNothing) {
  {
    auto folder = OutputFolder::open(parent / "full");
    const SmallDisk disk(1000);
    const auto written = folder->write("large.txt", std::string(100000, 'x'));
    CHECK_FALSE(written.has_value());
    CHECK(written.error().text().find("large.txt: cannot be written: ") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(parent / "full"));
}

TEST(OutputFolder, CannotReplaceAFile) {
  std::ofstream(parent / "file") << "x";
  const auto folder = OutputFolder::open(parent / "file");
  CHECK_FALSE(folder.has_value());
  STRCMP_CONTAINS("/file: ", folder.error().text().c_str());
  STRCMP_EQUAL("x", content(parent / "file").c_str());
}

TEST(OutputFolder, CannotBeInAReadOnlyFolder) {
  const auto folder = OutputFolder::open("/proc/supercoil");
  CHECK_FALSE(folder.has_value());
  STRCMP_CONTAINS("/proc/supercoil: cannot be created: ", folder.error().text().c_str());
  const auto existing = OutputFolder::open("/proc");
  CHECK_FALSE(existing.has_value());
  STRCMP_CONTAINS("/proc: cannot be written to: ", existing.error().text().c_str());
}
