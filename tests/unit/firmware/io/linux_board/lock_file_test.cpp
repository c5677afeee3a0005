#include "linux_board/lock_file.hpp"

#include <string>
#include <string_view>

#include <unistd.h>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil::linux_board;
using supercoil::test::TemporaryFolder;

TEST_GROUP(LockFile) {
  TemporaryFolder folder;

  /// The lock is not taken, for this reason, and not because another process holds it.
  void refused(std::string_view why) const {
    const auto lock = LockFile::take(folder / "lock");
    CHECK_FALSE(lock.has_value());
    STRCMP_EQUAL((folder / "lock" + ": the lock file " + std::string(why)).c_str(),
                 lock.error().text().c_str());
  }
};

TEST(LockFile, HasOnlyOneHolder) {
  {
    const auto first = LockFile::take(folder / "lock");
    CHECK(first.has_value());
    const auto second = LockFile::take(folder / "lock");
    CHECK_FALSE(second.has_value());
    const std::string why = folder / "lock" + ": another supercoild drives this board, process " +
                            std::to_string(::getpid());
    STRCMP_EQUAL(why.c_str(), second.error().text().c_str());
  }
  CHECK(LockFile::take(folder / "lock").has_value());
}

TEST(LockFile, ReportsAMissingFolder) {
  const auto lock = LockFile::take(folder / "none/lock");
  const std::string why = folder / "none/lock" +
                          ": the lock file cannot be created: No such file or directory; "
                          "create its folder, or name another (--run-folder)";
  STRCMP_EQUAL(why.c_str(), lock.error().text().c_str());
}

TEST(LockFile, DoesNotFollowASymbolicLink) {
  folder.write("other", "of somebody else");
  folder.link("lock", "other");
  refused("is a symbolic link, which is not followed");
  STRCMP_EQUAL("of somebody else", folder.read("other").c_str());
}

TEST(LockFile, DoesNotCreateTheTargetOfALink) {
  folder.link("lock", "absent");
  refused("is a symbolic link, which is not followed");
  CHECK(::access((folder / "absent").c_str(), F_OK) != 0);
}

TEST(LockFile, AFileWithTwoNamesIsLeftAlone) {
  folder.write("other", "of somebody else");
  CHECK_EQUAL(0, ::link((folder / "other").c_str(), (folder / "lock").c_str()));
  refused("has 2 names (hard links) and may be another file");
  STRCMP_EQUAL("of somebody else", folder.read("other").c_str());
}

TEST(LockFile, APipeIsRefusedWithoutWaiting) {
  folder.make_pipe("lock");
  refused("is not a regular file");
}

TEST(LockFile, AFolderIsRefused) {
  folder.make_folder("lock");
  refused("cannot be created: Is a directory");
}

/// Only root can give a file to another user.
TEST(LockFile, AFileOfAnotherUserIsLeftAlone) {
  if (::geteuid() != 0) return;
  constexpr uid_t somebody = 65534;
  folder.write("lock", "of somebody else");
  CHECK_EQUAL(0, ::chown((folder / "lock").c_str(), somebody, somebody));
  refused("belongs to user 65534, not to root, to this user or to its folder's owner");
  STRCMP_EQUAL("of somebody else", folder.read("lock").c_str());
}

/// As root's doctor finds it: the service's user owns both the folder and the file.
TEST(LockFile, MayBelongToTheOwnerOfItsFolder) {
  if (::geteuid() != 0) return;
  constexpr uid_t service = 65534;
  folder.write("lock", "1\n");
  for (const std::string& path : {folder.path(), folder / "lock"})
    CHECK_EQUAL(0, ::chown(path.c_str(), service, service));
  CHECK(LockFile::take(folder / "lock").has_value());
  STRCMP_EQUAL((std::to_string(::getpid()) + "\n").c_str(), folder.read("lock").c_str());
}
