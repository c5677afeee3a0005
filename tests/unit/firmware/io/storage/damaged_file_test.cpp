// Which set a store returns when a file is damaged, and what becomes of the damaged file.
#include <string>

#include <CppUTest/TestHarness.h>

#include "storage/codec.hpp"
#include "storage/envelope.hpp"
#include "unit/firmware/io/storage/support/store_on_a_disk.hpp"

using namespace supercoil::storage;
using namespace supercoil::test;

TEST_GROUP_BASE(DamagedFile, StoreOnADisk){};

TEST(DamagedFile, FallsBackToThePreviousVersionWithTheReason) {
  save(1);
  save(2);
  text_of(path).resize(100);
  check_loaded(Source::previous, 1,
               "/d/learned-3.toml: is cut off: 42 of 369 bytes after its first line");
  text_of(path).clear();
  check_loaded(Source::previous, 1, "/d/learned-3.toml: is empty");
  disk.names.erase(path);
  check_loaded(Source::previous, 1, "/d/learned-3.toml: is not there");
}

TEST(DamagedFile, OneExtraByteIsDetected) {
  save(1);
  save(2);
  text_of(path).append(max_file_bytes - text_of(path).size() + 1, '#');
  check_loaded(Source::previous, 1, "/d/learned-3.toml: is larger than the limit of 64 KiB");
}

TEST(DamagedFile, ReportsADamagedPreviousVersionWhileTheCurrentOneIsGood) {
  save(1);
  save(2);
  text_of(path + ".previous") = "x";
  check_loaded(Source::current, 2,
               "/d/learned-3.toml.previous: is not a stored set: it does not start with "
               "'# supercoil learned, format '");
}

TEST(DamagedFile, ReportsAnErrorWhenBothAreDamagedAndCanSaveAgain) {
  save(1);
  save(2);
  text_of(path).clear();
  text_of(path + ".previous") = "x";
  const auto loaded = store.load();
  CHECK_FALSE(loaded.has_value());
  STRCMP_CONTAINS("/d/learned-3.toml: is empty; /d/learned-3.toml.previous: is not a stored",
                  loaded.error().text().c_str());
  save(3);
  save(4);
  check_loaded(Source::current, 4);
  text_of(path).clear();
  check_loaded(Source::previous, 3, "/d/learned-3.toml: is empty");
}

TEST(DamagedFile, ADamagedFileNeverReplacesAGoodPreviousVersionAndIsKept) {
  save(1);
  save(2);
  text_of(path) = "damaged";
  save(3);
  STRCMP_EQUAL("damaged", text_of(path + ".damaged-1").c_str());
  LONGS_EQUAL(1, which(*decode(text_of(path + ".previous"))));
  check_loaded(Source::current, 3);
}

TEST(DamagedFile, KeepsTheFirstEightDamagedFilesAndTheLatest) {
  for (int n = 1; n <= 12; ++n) {
    save(n);
    text_of(path) = "damaged " + std::to_string(n);
  }
  save(13);
  STRCMP_EQUAL("damaged 1", text_of(path + ".damaged-1").c_str());
  STRCMP_EQUAL("damaged 8", text_of(path + ".damaged-8").c_str());
  STRCMP_EQUAL("damaged 12", text_of(path + ".damaged-9").c_str());
  CHECK_FALSE(disk.names.contains(path + ".damaged-10"));
}

TEST(DamagedFile, WithoutAPreviousVersionIsAnErrorAndNotEmpty) {
  save(1);
  text_of(path).clear();
  const auto loaded = store.load();
  CHECK_FALSE(loaded.has_value());
  STRCMP_EQUAL("/d/learned-3.toml: is empty; /d/learned-3.toml.previous: is not there",
               loaded.error().text().c_str());
}
