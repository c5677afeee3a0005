// The states of the disk in which a save may start.
#pragma once

#include <string>
#include <vector>

#include "storage/store.hpp"
#include "unit/firmware/io/storage/support/sets.hpp"
#include "unit/firmware/io/storage/support/simulated_files.hpp"

namespace supercoil::test {

inline const std::string current = "/d/learned-3.toml";
inline const std::string previous = current + ".previous";
inline constexpr int channel = 3;
inline constexpr int saved_set = 9;  ///< the set that is saved
inline constexpr int none = -2;

inline std::string text(int n, std::uint32_t version) {
  board::Learned set = nth_set(n);
  set.version = version;
  return storage::encode(set);
}

inline std::string damaged(int n, std::uint32_t version) {
  return text(n, version).substr(0, 200 + version);  // all different
}

/// The set that a board starts with from this disk; −1: garbage.
inline int loaded(const Content& content) {
  Disk disk(content);
  SimulatedFiles files(disk);
  const auto result = storage::LearnedStore("/d", channel, files).load();
  if (!result || !result->learned) return none;
  return which(*result->learned);
}

struct Start {
  const char* name;
  Content content;
};

/// Every kind of disk on which a save may start.
inline const std::vector<Start>& starts() {
  static const std::vector<Start> all{
      {"nothing stored", {}},
      {"one version", {{current, text(1, 1)}}},
      {"two versions", {{current, text(2, 2)}, {previous, text(1, 1)}}},
      {"the same in both names", {{current, text(2, 2)}, {previous, text(2, 2)}}},
      {"left over from a cut",
       {{current, text(2, 2)},
        {previous, text(1, 1)},
        {current + ".new", damaged(3, 3)},
        {previous + ".new", text(2, 2)}}},
      {"current gone", {{previous, text(1, 1)}}},
      {"current damaged", {{current, damaged(2, 2)}, {previous, text(1, 1)}}},
      {"current empty", {{current, ""}, {previous, text(1, 1)}}},
      {"previous damaged", {{current, text(2, 2)}, {previous, damaged(1, 1)}}},
      {"only one, damaged", {{current, damaged(1, 1)}}},
      {"both damaged", {{current, damaged(2, 2)}, {previous, damaged(1, 1)}}},
      {"damaged again",
       {{current, damaged(4, 4)}, {previous, text(3, 3)}, {current + ".damaged-1", damaged(2, 2)}}},
  };
  return all;
}

}  // namespace supercoil::test
