// Recordings that cannot be written, and how many are kept.
#include <cerrno>
#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/recorder/support/recorder_on_a_disk.hpp"

using namespace supercoil;
using namespace supercoil::test;
using recorder::FlightRecorder;

TEST_GROUP_BASE(Writing,
                RecorderOnADisk){void put(const std::string& name, const std::string& text = "x"){
    disk.change({"/d/" + name, std::make_shared<Inode>(Inode{text, text, false}), ""});
disk.sync_names();
}
bool exists(const std::string& name) {
  return disk.names.contains("/d/" + name);
}
void a_fault() {
  ticks.until(static_cast<double>(ticks.time_ns) * 1e-9 + 2.0);
  ticks.fault(0);
  ticks.until(static_cast<double>(ticks.time_ns) * 1e-9 + 1.1);
  ticks.reset();
}
}
;

TEST(Writing, NumbersCountUpFromTheHighestPresent) {
  put("flight-7.scfr");
  put("flight-12.scfr");
  a_fault();
  a_fault();
  CHECK(exists("flight-13.scfr") && exists("flight-14.scfr") && exists("flight-7.scfr"));
}

TEST(Writing, NumbersAreNotReusedWhenTheNewestIsRemoved) {
  a_fault();
  disk.names.erase("/d/flight-1.scfr");
  a_fault();
  CHECK(exists("flight-2.scfr"));
}

TEST(Writing, OnlyTheNewestTwentyAreKeptAndNothingElseIsTouched) {
  const std::string others[] = {
      "flight-.scfr",  "flight-01.scfr", "flight-1.scfr.bak", "flight-1x.scfr",
      "Flight-1.scfr", "notes.txt",      "flight-1.csv",      "flight--1.scfr",
      "flight-2.new",  "flight-0.scfr",  "x.scfr.new",        "flight-9999999999999999999.scfr"};
  for (const std::string& name : others)
    put(name);
  for (int i = 1; i <= 25; ++i)
    put("flight-" + std::to_string(i) + ".scfr");
  a_fault();
  CHECK(!exists("flight-6.scfr") && exists("flight-7.scfr") && exists("flight-26.scfr"));
  for (const std::string& name : others)
    CHECK_TEXT(exists(name), name.c_str());
}

TEST(Writing, FilesWithOtherNamesDoNotCount) {
  put("flight-01.scfr");
  for (int i = 1; i <= 19; ++i)
    put("flight-" + std::to_string(i) + ".scfr");
  a_fault();
  CHECK(exists("flight-1.scfr") && exists("flight-20.scfr"));
}

TEST(Writing, TheOldestIsRemovedBeforeTheNewOneIsCreated) {
  for (int i = 1; i <= 20; ++i)
    put("flight-" + std::to_string(i) + ".scfr");
  SimulatedFiles full(disk, {1, ENOSPC, false, false});  // call 0 removes, call 1 makes the file
  FlightRecorder failing("/d", 2, rate_Hz, full, settings_on(disk));
  Ticks{failing, 0, {Fault::over_travel, Fault::none}}.until(1.1);
  CHECK(!exists("flight-1.scfr") && exists("flight-2.scfr") && !exists("flight-21.scfr"));
  Ticks{failing, 2 * second_ns, {Fault::over_travel, Fault::none}}.until(7.0);
  CHECK_TEXT(exists("flight-2.scfr"), "the second try needs no more room");
  CHECK(exists("flight-21.scfr"));
}

TEST(Writing, AFailedRemovalDoesNotPreventOthers) {
  for (int i = 1; i <= 20; ++i)
    put("flight-" + std::to_string(i) + ".scfr");
  SimulatedFiles stuck(disk, {0, EISDIR, false, false});
  FlightRecorder recorder_("/d", 2, rate_Hz, stuck, settings_on(disk));
  Ticks{recorder_, 0, {Fault::over_travel, Fault::none}}.until(1.1);
  CHECK(exists("flight-1.scfr") && !exists("flight-2.scfr") && exists("flight-21.scfr"));
  const auto notes = recorder_.take_notes();
  LONGS_EQUAL(2, notes.size());
  CHECK(!notes[0].problem && notes[1].problem);
  STRCMP_CONTAINS("/d/flight-1.scfr: simulated: Is a directory", notes[1].text.c_str());
}

TEST(Writing, RemnantsOfAnInterruptedWriteAreRemoved) {
  put("flight-3.scfr.new");
  put("flight-1.scfr.new");
  a_fault();
  LONGS_EQUAL(1, recordings());
  CHECK(exists("flight-1.scfr"));
}

TEST(Writing, AFullDiskIsReportedLeavesNothingAndIsRetriedOnce) {
  SimulatedFiles full(disk, {1, ENOSPC, false, true});  // half of the header is written
  recorder::FlightRecorder failing("/d", 2, rate_Hz, full, settings_on(disk));
  Ticks t{failing};
  t.until(19.99);
  t.fault(0);
  t.until(21.01);
  auto notes = failing.take_notes();
  LONGS_EQUAL(1, notes.size());
  CHECK(notes[0].problem);
  STRCMP_EQUAL(
      "over_temperature (30) of channel 1 is not recorded: /d/flight-1.scfr.new: simulated: "
      "No space left on device; will try once more",
      notes[0].text.c_str());
  LONGS_EQUAL_TEXT(0, recordings(), "the half file is removed");
  t.until(26.01);
  LONGS_EQUAL(0, recordings());
  t.until(26.02);
  check_rows(recording(1).rows, 10.0, 21.0);
  notes = failing.take_notes();
  LONGS_EQUAL(1, notes.size());
  CHECK(!notes[0].problem);
}

TEST(Writing, TheSecondAttemptIsTheLastAndLaterFaultsAreRecorded) {
  SimulatedFiles full(disk, {1, EROFS, true, false});
  recorder::FlightRecorder failing("/d", 2, rate_Hz, full, settings_on(disk));
  Ticks t{failing, 0, {Fault::over_travel, Fault::none}};
  t.until(30.0);
  const auto notes = failing.take_notes();
  LONGS_EQUAL(2, notes.size());
  STRCMP_CONTAINS("Read-only file system; giving up", notes[1].text.c_str());
  const int calls = full.calls();
  t.until(60.0);
  LONGS_EQUAL(calls, full.calls());
}

TEST(Writing, APendingRetryDoesNotBlockAnotherFault) {
  SimulatedFiles once(disk, {1, ENOSPC, false, false});
  recorder::FlightRecorder failing("/d", 2, rate_Hz, once, settings_on(disk));
  Ticks t{failing};
  t.until(19.99);
  t.fault(0);
  t.until(22.99);
  t.fault(1, Fault::over_travel);
  t.until(30.0);
  LONGS_EQUAL(2, recordings());
  STRCMP_EQUAL("over_travel", recording(1).header.fault_name.c_str());
  check_rows(recording(1).rows, 13.0, 24.0);
  check_rows(recording(2).rows, 10.0, 21.0);  // the one that failed at first
}

TEST(Writing, SuccessiveFaultsOnAFailingDiskAreEachTriedTwice) {
  SimulatedFiles broken(disk, {0, EIO, true, false});
  recorder::FlightRecorder failing("/d", 2, rate_Hz, broken, settings_on(disk));
  Ticks t{failing};
  for (int i = 0; i < 10; ++i) {
    t.fault(0);
    t.until(i * 1.5 + 0.2);
    t.reset();
    t.until(i * 1.5 + 1.4);
  }
  t.until(40.0);
  LONGS_EQUAL(20, failing.take_notes().size());
}

TEST(Writing, FinishRetriesPendingRecordingsAtOnce) {
  SimulatedFiles once(disk, {1, ENOSPC, false, false});
  recorder::FlightRecorder failing("/d", 2, rate_Hz, once, settings_on(disk));
  Ticks t{failing, 0, {Fault::over_travel, Fault::none}};
  t.until(2.0);
  LONGS_EQUAL(0, recordings());
  failing.finish();
  check_rows(recording(1).rows, 0.0, 1.0);
}

TEST(Writing, AFailedListingIsReportedLikeAnyProblem) {
  recorder::RecorderSettings settings;  // the real list of a folder that does not exist
  recorder::FlightRecorder failing("/none/there", 2, rate_Hz, files, settings);
  Ticks{failing, 0, {Fault::over_travel, Fault::none}}.until(2.0);
  const auto notes = failing.take_notes();
  LONGS_EQUAL(1, notes.size());
  STRCMP_CONTAINS("/none/there: cannot be listed: No such file or directory",
                  notes[0].text.c_str());
  LONGS_EQUAL(0, files.calls());
}

TEST(Writing, UnreadNotesAreBounded) {
  for (int i = 0; i < 40; ++i)
    a_fault();
  const auto notes = recorder.take_notes();
  LONGS_EQUAL(32, notes.size());
  STRCMP_CONTAINS("flight-40.scfr", notes.back().text.c_str());
}
