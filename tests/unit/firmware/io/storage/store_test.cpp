#include "storage/store.hpp"

#include <cerrno>
#include <limits>
#include <memory>
#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/storage/support/store_on_a_disk.hpp"

using namespace supercoil;
using namespace supercoil::storage;
using namespace supercoil::test;

TEST_GROUP_BASE(LearnedStore, StoreOnADisk){};

TEST(LearnedStore, IsEmptyAtFirst) {
  const auto loaded = store.load();
  CHECK(loaded.has_value());
  CHECK(loaded->source == Source::nothing);
  CHECK_FALSE(loaded->learned.has_value());
  CHECK(loaded->problems.empty());
}

TEST(LearnedStore, ReturnsTheLastSavedSet) {
  for (const int n : {1, 2, 3})
    save(n);
  check_loaded(Source::current, 3);
}

TEST(LearnedStore, CountsVersionsItself) {
  board::Learned set = nth_set(1);
  set.version = 77;
  LONGS_EQUAL(1, *store.save(set));
  LONGS_EQUAL(2, *store.save(nth_set(2)));
  LONGS_EQUAL(2, store.load()->learned->version);
}

TEST(LearnedStore, DatesAnIdentificationByItsFirstSave) {
  double now_s = 1.7e9;
  LearnedStore dated("/d", 3, files, [&] { return now_s; });
  const auto identified_s = [&](const board::Learned& set) {
    CHECK(dated.save(set).has_value());
    return dated.load()->learned->identification.identified_s;
  };
  board::Learned set = nth_set(1);
  DOUBLES_EQUAL(0.0, identified_s(set), 0.0);
  set.identification.deviation_ratio = {0.0, 0.2, 0.1, 0.05};
  DOUBLES_EQUAL(1.7e9, identified_s(set), 0.0);
  // A later calibration stores the muscle again, without a date, as the loop has it.
  now_s += 60.0;
  DOUBLES_EQUAL(1.7e9, identified_s(set), 0.0);
  LONGS_EQUAL(2, dated.load()->learned->version);
  set.calibration.position_scale = 1.25;
  DOUBLES_EQUAL(1.7e9, identified_s(set), 0.0);
  set.identification.deviation_ratio[3] = 0.04;
  DOUBLES_EQUAL(1.7e9 + 60.0, identified_s(set), 0.0);
  set.identification.identified_s = 1.6e9;
  DOUBLES_EQUAL(1.6e9, identified_s(set), 0.0);
}

TEST(LearnedStore, ForgetsEverythingAndStartsAgain) {
  save(1);
  save(2);
  CHECK(store.forget().has_value());
  CHECK(store.load()->source == Source::nothing);
  CHECK(store.load()->problems.empty());
  LONGS_EQUAL(2, which(*decode(text_of(path + ".cleared"))));
  LONGS_EQUAL(1, *store.save(nth_set(3)));
  check_loaded(Source::current, 3);
  CHECK(store.forget().has_value());
  CHECK(store.forget().has_value());
  LONGS_EQUAL(3, which(*decode(text_of(path + ".cleared"))));
}

TEST(LearnedStore, KeepsTheComparisonOfTheSensesWhenTheMuscleIsForgotten) {
  board::Learned set = nth_set(1);
  set.senses = {1.25, 0.875, 0.0625, 1.7e9};
  CHECK(store.save(nth_set(2)).has_value());
  CHECK(store.save(set).has_value());
  for (int i = 0; i < 2; ++i) {
    CHECK(store.forget().has_value());
    const auto kept = store.load()->learned;
    CHECK(kept.has_value());
    CHECK_FALSE(kept->has_muscle);
    CHECK(kept->senses == set.senses);
    LONGS_EQUAL(1, kept->version);
    // It still holds the muscle, because there was nothing to forget the second time.
    CHECK(decode(text_of(path + ".cleared"))->has_muscle);
  }
}

TEST(LearnedStore, KeepsTheTuningWhenTheMuscleIsForgotten) {
  board::Learned set = nth_set(1);
  set.tuning.controllers[2].values[5] = 6.5;
  CHECK(store.save(set).has_value());
  CHECK(store.forget().has_value());
  const auto kept = store.load()->learned;
  CHECK(kept.has_value());
  CHECK_FALSE(kept->has_muscle);
  CHECK(kept->tuning == set.tuning);
}

TEST(LearnedStore, ForgetsTheHeatTogetherWithTheMuscle) {
  for (const bool has_muscle : {true, false}) {
    board::Learned set = nth_set(1);
    set.senses = {1.25, 0.875, 0.0625, 1.7e9};
    set.heat = {1.75, 2.25, 21.5, 1.25, 1.5, 1.625};
    set.has_muscle = has_muscle;
    CHECK(store.save(set).has_value());
    CHECK(store.forget().has_value());
    CHECK(store.load()->learned->heat == board::ThermalFacts{});
    CHECK(store.load()->learned->senses == set.senses);
  }
}

TEST(LearnedStore, StillSavesWhenTheVersionsHaveRunOut) {
  board::Learned last = nth_set(1);
  last.version = std::numeric_limits<std::uint32_t>::max();
  save(2);
  text_of(path) = encode(last);
  CHECK(*store.save(nth_set(3)) == std::numeric_limits<std::uint32_t>::max());
  check_loaded(Source::current, 3);
}

TEST(LearnedStore, WritesNothingWhenTheContentIsUnchanged) {
  save(1);
  save(2);
  const int changes = files.changes();
  LONGS_EQUAL(2, *store.save(nth_set(2)));
  LONGS_EQUAL(changes, files.changes());
}

TEST(LearnedStore, SyncsTheFolderWhenAnEarlierSaveDidNot) {
  const int calls = [] {
    Disk trial;
    SimulatedFiles counted(trial);
    static_cast<void>(LearnedStore("/d", 3, counted).save(nth_set(1)));
    return counted.calls();
  }();
  SimulatedFiles failing(disk, {calls - 1, EIO, false, false});
  LearnedStore unsure("/d", 3, failing);
  CHECK_FALSE(unsure.save(nth_set(1)).has_value());
  CHECK(disk.survivors().size() > 1);
  const int before = failing.calls();
  CHECK(unsure.save(nth_set(1)).has_value());
  LONGS_EQUAL(1, disk.survivors().size());
  // Only once: from then on the save is known to be on the disk.
  const int with_sync = failing.calls() - before;
  CHECK(unsure.save(nth_set(1)).has_value());
  LONGS_EQUAL(before + 2 * with_sync - 1, failing.calls());
}

TEST(LearnedStore, SyncsTheFolderAgainAfterAFailedSave) {
  const int calls = [] {
    Disk trial;
    SimulatedFiles counted(trial);
    LearnedStore sure("/d", 3, counted);
    static_cast<void>(sure.save(nth_set(1)));
    static_cast<void>(sure.save(nth_set(2)));
    return counted.calls();
  }();
  SimulatedFiles failing(disk, {calls - 1, EIO, false, false});
  LearnedStore unsure("/d", 3, failing);
  CHECK(unsure.save(nth_set(1)).has_value());
  CHECK_FALSE(unsure.save(nth_set(2)).has_value());
  CHECK(disk.survivors().size() > 1);
  CHECK(unsure.save(nth_set(2)).has_value());
  LONGS_EQUAL(1, disk.survivors().size());
}

TEST(LearnedStore, RefusesAnInvalidSetAndTouchesNothing) {
  save(1);
  const Content before = disk.seen();
  const int changes = files.changes();
  board::Learned bad = nth_set(2);
  bad.muscle.stiffness_N_per_m = -16.0;
  const auto saved = store.save(bad);
  CHECK_FALSE(saved.has_value());
  STRCMP_EQUAL("is not stored: stiffness_N_per_m = -16 is out of range: must be 0.01 to 1e+06",
               saved.error().text().c_str());
  bad.muscle.stiffness_N_per_m = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(store.save(bad).has_value());
  CHECK(disk.seen() == before);
  LONGS_EQUAL(changes, files.changes());
}

TEST(LearnedStore, ReportsWhyRemnantsCannotBeRemoved) {
  save(1);
  disk.change({path + ".new", std::make_shared<Inode>(), ""});
  SimulatedFiles failing(disk, {2, EACCES, false, false});  // after both files were read
  const auto saved = LearnedStore("/d", 3, failing).save(nth_set(2));
  CHECK_FALSE(saved.has_value());
  STRCMP_EQUAL("/d/learned-3.toml.new: simulated: Permission denied", saved.error().text().c_str());
}

// Linux refuses to remove even a file that is not there.
TEST(LearnedStore, OfAReadOnlyDiskItSaysThatNothingCanBeCreatedThere) {
  save(1);
  SimulatedFiles read_only(disk, {2, EROFS, true, false});  // after both files were read
  const auto saved = LearnedStore("/d", 3, read_only).save(nth_set(2));
  CHECK_FALSE(saved.has_value());
  STRCMP_EQUAL("/d/learned-3.toml.new: simulated creation: Read-only file system",
               saved.error().text().c_str());
}

TEST(LearnedStore, LoadingChangesNothing) {
  save(1);
  save(2);
  text_of(path) = "damaged";
  const Content before = disk.seen();
  const int changes = files.changes();
  static_cast<void>(store.load());
  CHECK(disk.seen() == before);
  LONGS_EQUAL(changes, files.changes());
}

TEST(LearnedStore, LeavesNothingButItsFilesBehind) {
  for (int n = 1; n <= 3; ++n)
    save(n);
  LONGS_EQUAL(2, disk.names.size());
}

/// A power cut between the two renames of a save may leave this state: a third name could not be
/// renamed over the second name of the same file.
TEST(LearnedStore, LeavesNothingBehindWhenBothNamesAreOneFile) {
  save(1);
  save(2);
  disk.names.at(path + ".previous") = disk.names.at(path);
  save(3);
  LONGS_EQUAL(2, disk.names.size());
  check_loaded(Source::current, 3);
  LONGS_EQUAL(2, which(*decode(text_of(path + ".previous"))));
}

TEST(LearnedStore, ChannelsAreIndependent) {
  LearnedStore other("/d", 4, files);
  save(1);
  CHECK(other.load()->source == Source::nothing);
  CHECK(other.save(nth_set(2)).has_value());
  check_loaded(Source::current, 1);
}

TEST(LearnedStore, SyncsTheFolderWhenItCouldNotForget) {
  const int calls = [] {
    Disk trial;
    SimulatedFiles counted(trial);
    LearnedStore whole("/d", 3, counted);
    for (const int n : {1, 2})
      static_cast<void>(whole.save(nth_set(n)));
    const int before = counted.calls();
    static_cast<void>(whole.load());
    return before + counted.calls() - before;
  }();
  // The first call after this that fails is the folder's, after the previous set is gone.
  int failed = 0;
  for (int at = calls; at < calls + 20; ++at) {
    Disk trial;
    SimulatedFiles failing(trial, {at, EIO, false, false});
    LearnedStore unsure("/d", 3, failing);
    for (const int n : {1, 2})
      CHECK(unsure.save(nth_set(n)).has_value());
    if (unsure.forget().has_value() || !trial.names.contains(path)) continue;
    ++failed;
    CHECK(unsure.save(nth_set(2)).has_value());
    LONGS_EQUAL(1, trial.survivors().size());
  }
  CHECK(failed > 0);
}
