#include "daemon/local_commands.hpp"

#include <sys/stat.h>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/temporary_folder.hpp"

using supercoil::daemon::LocalCommands;
using supercoil::test::TemporaryFolder;

TEST_GROUP(LocalCommands) {
  TemporaryFolder folder;
  mode_t usual = 0;

  void setup() override {
    usual = ::umask(0022);
  }
  void teardown() override {
    ::umask(usual);
  }
};

TEST(LocalCommands, OwnerAndGroupMayCommandWhateverTheUmask) {
  for (const mode_t mask : {0U, 0007U, 0077U}) {
    ::umask(mask);
    const auto commands = LocalCommands::open(folder / "commands");
    CHECK(commands.has_value());
    struct stat made {};
    CHECK_EQUAL(0, ::lstat((folder / "commands").c_str(), &made));
    CHECK(S_ISSOCK(made.st_mode));
    LONGS_EQUAL(0660, made.st_mode & 07777U);
    LONGS_EQUAL(mask, ::umask(mask));
  }
}

/// Whoever owns the folder can leave anything there before the socket is made.
TEST(LocalCommands, WhatALinkInItsPlacePointsToStaysAsItWas) {
  folder.write("other", "of somebody else");
  CHECK_EQUAL(0, ::chmod((folder / "other").c_str(), 0600));
  folder.link("commands", "other");
  CHECK(LocalCommands::open(folder / "commands").has_value());
  struct stat other {};
  CHECK_EQUAL(0, ::stat((folder / "other").c_str(), &other));
  LONGS_EQUAL(0600, other.st_mode & 07777U);
  STRCMP_EQUAL("of somebody else", folder.read("other").c_str());
}
