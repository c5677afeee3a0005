#include "linux_board/captures.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/scan_tree.hpp"

using namespace supercoil;
using namespace supercoil::linux_board;
using namespace supercoil::test;

namespace {

config::ConverterAddress captured(const std::string& input, const std::string& device = "ads7951") {
  return {device, input, {}, config::Capture{"supercoil", 64}};
}

/// A scan of voltage0, voltage2 and voltage4: 3 x 2 bytes (be:u12/16>>2), 2 of padding, the time.
std::string scan(const std::array<int, 3>& counts, std::int64_t time_ns) {
  std::string bytes;
  for (const int count : counts) {
    bytes += static_cast<char>(count >> 6);
    bytes += static_cast<char>(count << 2 & 0xFF);
  }
  bytes += "pd";
  for (int i = 0; i < 8; ++i)
    bytes += static_cast<char>(time_ns >> (8 * i));
  return bytes;
}

}  // namespace

TEST_GROUP(Captures) {
  ScanTree board;
  config::BoardWiring wiring;
  hal_linux::Machine machine;

  void setup() override {
    board.tree.link("sys/bus/iio/devices", "bus");
    machine.sys = board.tree / "sys";
    machine.dev = board.tree / "dev";
    wiring.supply = captured("voltage4");
    wiring.channels.resize(1);
    wiring.channels[0].position = captured("voltage0");
    wiring.channels[0].current = captured("voltage2");
  }
  long times_enabled() const {
    return std::count(board.writes.begin(), board.writes.end(), "buffer/enable 1");
  }
};

TEST(Captures, ADeviceRunsOnceForAllItsInputs) {
  Captures captures(wiring, machine);
  const auto supply = captures.open(wiring.supply);
  const auto position = captures.open(wiring.channels[0].position);
  const auto current = captures.open(wiring.channels[0].current);
  if (!supply) FAIL(supply.error().text().c_str());
  CHECK(position.has_value());
  CHECK(current.has_value());
  LONGS_EQUAL(1, times_enabled());
  board.tree.write("dev/iio:device0", scan({1000, 2000, 3000}, 77));
  const hal::Sample first = (*position)->latest();
  STRCMP_EQUAL("ok", hal::text(first.status));
  LONGS_EQUAL(1000, first.counts);
  LONGS_EQUAL(77, first.taken.count());
  LONGS_EQUAL(2000, (*current)->latest().counts);
  LONGS_EQUAL(3000, (*supply)->latest().counts);
}

TEST(Captures, ADeviceRunsUntilItsLastInputIsReleased) {
  std::unique_ptr<hal::AdcChannel> kept;
  {
    Captures captures(wiring, machine);
    kept = std::move(*captures.open(wiring.supply));
    STRCMP_EQUAL("1\n", board.attribute("buffer/enable").c_str());
  }
  STRCMP_EQUAL("1\n", board.attribute("buffer/enable").c_str());
  kept.reset();
  STRCMP_EQUAL("0\n", board.attribute("buffer/enable").c_str());
}

TEST(Captures, AMissingDeviceIsReportedForEachInput) {
  wiring.channels[0].position = captured("voltage0", "ads9999");
  Captures captures(wiring, machine);
  for (int i = 0; i < 2; ++i) {
    const auto position = captures.open(wiring.channels[0].position);
    CHECK_FALSE(position.has_value());
    STRCMP_CONTAINS("'ads9999'", position.error().text().c_str());
    STRCMP_CONTAINS("'ads7951'", position.error().text().c_str());
  }
}
