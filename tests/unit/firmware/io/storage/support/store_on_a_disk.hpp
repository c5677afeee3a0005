// A store on a simulated disk.
#pragma once

#include <string>

#include <CppUTest/TestHarness.h>

#include "storage/store.hpp"
#include "unit/firmware/io/storage/support/sets.hpp"
#include "unit/firmware/io/storage/support/simulated_files.hpp"

namespace supercoil::test {

/// The base class of a test group.
struct StoreOnADisk : Utest {
  const std::string path = "/d/learned-3.toml";
  Disk disk;
  SimulatedFiles files{disk};
  storage::LearnedStore store{"/d", 3, files};

  std::string& text_of(const std::string& name) {
    CHECK_TEXT(disk.names.contains(name), name.c_str());
    return disk.names.at(name)->seen;
  }
  void save(int n) { CHECK(store.save(nth_set(n)).has_value()); }
  void check_loaded(storage::Source source, int n, const char* problem = "") {
    const auto loaded = store.load();
    CHECK(loaded.has_value());
    CHECK(loaded->source == source);
    LONGS_EQUAL(n, which(*loaded->learned));
    const bool falls_back = source == storage::Source::previous;
    const std::string told =
        std::string(problem) + (falls_back ? "; the version before it is used" : "");
    STRCMP_EQUAL(told.c_str(), loaded->problems.empty() ? "" : loaded->problems.front().c_str());
  }
};

}  // namespace supercoil::test
