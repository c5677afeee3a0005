#include "linux_board/lock_file.hpp"

#include <unistd.h>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil::linux_board;
using supercoil::test::TemporaryFolder;

TEST_GROUP(LockFile) {
  TemporaryFolder folder;
};

TEST(LockFile, OnlyOneHoldsIt) {
  {
    const auto first = LockFile::take(folder / "lock");
    CHECK(first.has_value());
    const auto second = LockFile::take(folder / "lock");
    CHECK_FALSE(second.has_value());
    const std::string why = folder / "lock" + ": another supercoild drives this board, process " +
                            std::to_string(::getpid());
    STRCMP_EQUAL(why.c_str(), second.error().c_str());
  }
  CHECK(LockFile::take(folder / "lock").has_value());
}

TEST(LockFile, WithoutItsFolderItSaysSo) {
  const auto lock = LockFile::take(folder / "none/lock");
  const std::string why =
      folder / "none/lock" + ": the lock file cannot be made: No such file or directory";
  STRCMP_EQUAL(why.c_str(), lock.error().c_str());
}
