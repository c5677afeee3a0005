// A save that is stopped at every call, in every way, from every possible initial state.
#include <cerrno>
#include <set>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "storage/codec.hpp"
#include "storage/store.hpp"
#include "unit/firmware/io/storage/support/starts.hpp"

using namespace supercoil::storage;
using namespace supercoil::test;

namespace {

/// The damaged contents under a name that this program reads or keeps.
std::set<std::string> damaged_of(const Content& content) {
  std::set<std::string> found;
  for (const auto& [name, content_of] : content) {
    if (!name.ends_with(".new") && !decode(content_of)) found.insert(content_of);
  }
  return found;
}

bool holds(const Content& content, const std::string& wanted) {
  for (const auto& [name, content_of] : content) {
    if (content_of == wanted) return true;
  }
  return false;
}

/// Which set a file holds; −1: garbage, or no such file.
int set_in(const Content& content, const std::string& name) {
  const auto found = content.find(name);
  const auto set = decode(found == content.end() ? "" : found->second);
  return set ? which(*set) : -1;
}

/// Every kind of mishap at one call.
std::vector<Mishap> mishaps(int call) {
  std::vector<Mishap> all;
  for (const bool takes_effect : {false, true}) {
    all.push_back({call, 0, true, takes_effect});
    for (const int error : {ENOSPC, EIO, EROFS, EMFILE, EDQUOT}) {
      for (const bool for_good : {false, true})
        all.push_back({call, error, for_good, takes_effect});
    }
  }
  return all;
}

}  // namespace

TEST_GROUP(PowerCut) {
  std::string context;

  void expect(bool condition, const char* what) const {
    CHECK_TEXT(condition, (context + ": " + what).c_str());
  }

  static bool start_loads(const Start& start) {
    Disk disk(start.content);
    SimulatedFiles files(disk);
    return LearnedStore("/d", channel, files).load().has_value();
  }

  /// Checks what the board may find after the cut, and that it can continue.
  void check_survivor(const Start& start, const Content& content, int before) const {
    const int now = loaded(content);
    expect(now == before || now == saved_set, "load() gives the old set or the new one");
    for (const std::string& bad : damaged_of(start.content))
      expect(holds(content, bad), "damaged files are kept");
    Disk disk(content);
    SimulatedFiles files(disk);
    expect(LearnedStore("/d", channel, files).save(nth_set(saved_set)).has_value(), "saves again");
    for (const Content& later : disk.survivors())
      expect(loaded(later) == saved_set, "what was saved again is there after another cut");
  }

  /// Returns the number of different disks that a power cut may leave.
  int check_save(const Start& start, const Mishap& mishap, std::set<Content>& checked) {
    context = std::string(start.name) + ", call " + std::to_string(mishap.at_call) + ", error " +
              std::to_string(mishap.error) + (mishap.takes_effect ? ", takes effect" : "") +
              (mishap.for_good ? ", for good" : "");
    const int before = loaded(start.content);
    Disk disk(start.content);
    SimulatedFiles files(disk, mishap);
    const auto result = LearnedStore("/d", channel, files).save(nth_set(saved_set));
    const int seen = loaded(disk.seen());
    expect(seen == before || seen == saved_set,
           "the program goes on with the old set or the new one");
    const auto survivors = disk.survivors();
    for (const Content& content : survivors) {
      if (result) expect(loaded(content) == saved_set, "what is reported as saved survives");
      if (checked.insert(content).second) check_survivor(start, content, before);
    }
    return static_cast<int>(survivors.size());
  }
};

TEST(PowerCut, AtEveryCallOfASaveLeavesTheOldSetOrTheNewOneWhole) {
  int cases = 0;
  int disks = 0;
  for (const Start& start : starts()) {
    Disk disk(start.content);
    SimulatedFiles files(disk);
    CHECK(LearnedStore("/d", channel, files).save(nth_set(saved_set)).has_value());
    std::set<Content> checked;
    for (int call = 0; call < files.calls(); ++call) {
      for (const Mishap& mishap : mishaps(call)) {
        disks += check_save(start, mishap, checked);
        ++cases;
      }
    }
  }
  CHECK_TEXT(cases > 2000, "every call was disturbed");
  CHECK_TEXT(disks > 5000, "every disk that a cut may leave was looked at");
}

TEST(PowerCut, AfterASaveKeepsThePreviousVersionToo) {
  for (const Start& start : starts()) {
    const int before = loaded(start.content);
    Disk disk(start.content);
    SimulatedFiles files(disk);
    CHECK(LearnedStore("/d", channel, files).save(nth_set(saved_set)).has_value());
    for (const Content& content : disk.survivors()) {
      LONGS_EQUAL_TEXT(saved_set, set_in(content, current), start.name);
      if (before != none) LONGS_EQUAL_TEXT(before, set_in(content, previous), start.name);
    }
  }
}

TEST(PowerCut, AtEveryCallOfForgettingLeavesTheOldSetOrNone) {
  int disks = 0;
  for (const Start& start : starts()) {
    const int before = loaded(start.content);
    Disk whole(start.content);
    SimulatedFiles undisturbed(whole);
    CHECK(LearnedStore("/d", channel, undisturbed).forget().has_value());
    for (int call = 0; call < undisturbed.calls(); ++call) {
      for (const Mishap& mishap : mishaps(call)) {
        context = std::string(start.name) + ", call " + std::to_string(call);
        Disk disk(start.content);
        SimulatedFiles files(disk, mishap);
        const auto result = LearnedStore("/d", channel, files).forget();
        for (const Content& content : disk.survivors()) {
          ++disks;
          const int now = loaded(content);
          expect(now == none || (now == before && !result), "the old set, or none when it is said");
          Disk later(content);
          SimulatedFiles files_later(later);
          const auto there = LearnedStore("/d", channel, files_later).load();
          const bool started_before = start_loads(start);
          expect(there.has_value() || !started_before, "the board still starts");
        }
      }
    }
  }
  CHECK_TEXT(disks > 1000, "every disk that a cut may leave was looked at");
}

TEST(PowerCut, NeverLeavesOneFileUnderBothNames) {
  // Two names for one file are only one version: the save must not pass through that state, because
  // after damage to that file there would be no other.
  const Content two{{current, text(2, 2)}, {previous, text(1, 1)}};
  for (int call = 0; call < 12; ++call) {
    Disk disk(two);
    SimulatedFiles files(disk, {call, 0, true, true});
    static_cast<void>(LearnedStore("/d", channel, files).save(nth_set(saved_set)));
    CHECK(disk.names[current] != disk.names[previous]);
  }
}
