// A recorder of two channels at 100 Hz on a simulated disk.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "recorder/flight_recorder.hpp"
#include "recorder/recording.hpp"
#include "unit/firmware/io/recorder/support/rows.hpp"
#include "unit/firmware/io/storage/support/simulated_files.hpp"

namespace supercoil::test {

/// The names in "/d".
inline recorder::ListFolder names_on(const Disk& disk) {
  return [&disk](const std::string& folder) -> Result<std::vector<std::string>> {
    std::vector<std::string> names;
    for (const auto& [path, inode] : disk.names)
      names.push_back(path.substr(folder.size() + 1));
    return names;
  };
}

inline recorder::RecorderSettings settings_on(const Disk& disk) {
  recorder::RecorderSettings settings;
  settings.list = names_on(disk);
  return settings;
}

/// Adds ticks over time, with the fault that each channel has from some time on.
struct Ticks {
  recorder::FlightRecorder& recorder;
  std::int64_t time_ns = 0;
  Fault faults[2] = {Fault::none, Fault::none};

  /// Up to and including this time.
  void until(double time_s) {
    for (; time_ns <= std::llround(time_s * 1e9); time_ns += tick_ns) {
      recorder.add(row(time_ns, 0, faults[0]));
      recorder.add(row(time_ns, 1, faults[1]));
    }
  }
  /// The channel has the fault from the next tick on.
  void fault(int channel, Fault fault = Fault::over_temperature) { faults[channel] = fault; }
  void reset() { faults[0] = faults[1] = Fault::none; }
};

/// The base class of a test group.
struct RecorderOnADisk : Utest {
  Disk disk;
  SimulatedFiles files{disk};
  recorder::FlightRecorder recorder{"/d", 2, rate_Hz, files, settings_on(disk)};
  Ticks ticks{recorder};

  std::size_t recordings() const { return disk.names.size(); }
  recorder::Recording recording(int number) {
    const std::string path = "/d/flight-" + std::to_string(number) + ".scfr";
    CHECK_TEXT(disk.names.contains(path), path.c_str());
    auto read = recorder::decode(disk.names.at(path)->seen, recorder::Damaged::refuse);
    CHECK_TEXT(read.has_value(), read ? "" : read.error().text().c_str());
    return *read;
  }
  /// One line per note; problems begin with "! ".
  std::string notes() {
    std::string all;
    for (const auto& note : recorder.take_notes())
      all += (note.problem ? "! " : "") + note.text + "\n";
    return all;
  }
};

/// Every tick of both channels between these times, in order and complete.
inline void check_rows(const std::vector<Row>& rows, double from_s, double to_s) {
  const std::int64_t from_ns = std::llround(from_s * 1e9);
  const std::int64_t to_ns = std::llround(to_s * 1e9);
  LONGS_EQUAL(2 * ((to_ns - from_ns) / tick_ns + 1), static_cast<long>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto time_ns = from_ns + static_cast<std::int64_t>(i / 2) * tick_ns;
    const auto expected = row(time_ns, static_cast<int>(i % 2));
    CHECK(rows[i].time_ns == expected.time_ns && rows[i].channel == expected.channel);
    CHECK(rows[i].position_m == expected.position_m);
  }
}

}  // namespace supercoil::test
