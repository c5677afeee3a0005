// Long random histories of one board: saves, power cuts, failing disks, damaged files.
#include <cerrno>
#include <set>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "storage/store.hpp"
#include "unit/firmware/io/storage/support/sets.hpp"
#include "unit/firmware/io/storage/support/simulated_files.hpp"

using namespace supercoil::storage;
using namespace supercoil::test;

namespace {

const std::string path = "/d/learned-1.toml";

/// A board that is used until its power goes, again and again. At each moment it is known what
/// load() may return: the last set whose save was reported, or one that was tried after it.
class Board {
 public:
  void run_once() {
    Disk disk(content_);
    const Mishap mishap{*rc::gen::inRange(-1, 40), *rc::gen::element(0, ENOSPC, EIO, EROFS),
                        *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>()};
    SimulatedFiles files(disk, mishap);
    LearnedStore store("/d", 1, files);
    const int saves = *rc::gen::inRange(1, 4);
    for (int i = 0; i < saves; ++i) {
      const int n = *rc::gen::inRange(1, 5);  // few, so that the same content recurs
      allowed_.insert(n);
      if (store.save(nth_set(n))) allowed_ = {n};
      check(disk.seen());
    }
    const auto survivors = disk.survivors();
    content_ = survivors[*rc::gen::inRange<std::size_t>(0, survivors.size())];
    check(content_);
  }

  /// Damages one of the two files if the other one can replace it.
  void damage() {
    const bool current = *rc::gen::arbitrary<bool>();
    const std::string hit = current ? path : path + ".previous";
    const std::string other = current ? path + ".previous" : path;
    if (!content_.contains(hit) || !content_.contains(other) || !decode(content_[other])) return;
    content_[hit].resize(*rc::gen::inRange<std::size_t>(0, content_[hit].size() + 1));
    if (current) allowed_ = {loaded(content_)};
  }

 private:
  static int loaded(const Content& content) {
    Disk disk(content);
    SimulatedFiles files(disk);
    const auto result = LearnedStore("/d", 1, files).load();
    if (!result) return -2;
    return result->learned ? which(*result->learned) : 0;
  }
  void check(const Content& content) const { RC_ASSERT(allowed_.contains(loaded(content))); }

  Content content_;
  std::set<int> allowed_{0};  ///< 0: nothing stored yet
};

}  // namespace

TEST_GROUP(History){};

TEST(History, OfAnyKindEndsWithASavedSet) {
  CHECK(rc::check("histories", [] {
    Board board;
    const int lives = *rc::gen::inRange(1, 12);
    for (int i = 0; i < lives; ++i) {
      board.run_once();
      if (*rc::gen::inRange(0, 3) == 0) board.damage();
    }
  }));
}
