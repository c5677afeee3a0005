// Uses real threads; also runs under ThreadSanitizer. No test depends on their speed.
#include "supercoil/hal_linux/bus_thread.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/buffered_adc.hpp"
#include "supercoil/hal_linux/buffered_pwm.hpp"
#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "unit/hal_linux/support/fakes.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;
using namespace std::chrono_literals;

namespace {

/// Blocks for a time, as a bus does.
struct Slow final : BusDevice {
  void serve() override {
    started.push_back(MonotonicClock::time());
    std::this_thread::sleep_for(started.size() == 1 ? first : then);
  }
  std::vector<hal::Time> started;  ///< read only after the bus has ended
  std::chrono::nanoseconds first{};
  std::chrono::nanoseconds then{};
};

}  // namespace

TEST_GROUP(BusOfDevices) {
  FakeAdc* good_device = new FakeAdc;
  FakeAdc* bad_device = new FakeAdc;
  FakePwm* pwm_device = new FakePwm;
  BufferedAdc good{std::unique_ptr<hal::AdcChannel>(good_device)};
  BufferedAdc bad{std::unique_ptr<hal::AdcChannel>(bad_device)};
  BufferedPwm pwm{std::unique_ptr<hal::PwmOutput>(pwm_device)};
  Slow slow;

  std::unique_ptr<BusThread> started(hal::Duration period) {
    auto bus = BusThread::start({"i2c-1"}, period, {&pwm, &bad, &good, &slow});
    if (!bus) FAIL(bus.error().text().c_str());
    return std::move(*bus);
  }
  static void wait_for_rounds(const BusThread& bus, std::uint64_t rounds) {
    const auto until = bus.health().rounds.load() + rounds;
    while (bus.health().rounds.load() < until)
      std::this_thread::sleep_for(100us);
  }
};

TEST(BusOfDevices, HasNoTimesBeforeItsFirstRound) {
  const BusHealth health;
  UNSIGNED_LONGS_EQUAL(0, health.rounds.load());
  UNSIGNED_LONGS_EQUAL(0, health.skipped.load());
  LONGS_EQUAL(0, health.max_round_ns.load());
}

TEST(BusOfDevices, ServesEveryDeviceWhileAnotherFails) {
  bad_device->status = hal::Status::io_error;
  const auto bus = started(200us);
  for (int step = 1; step < 200; ++step) {
    static_cast<void>(pwm.set(step));
    const hal::Sample sample = good.latest();
    CHECK(sample.counts == sample.taken.count());
    const auto status = bad.latest().status;
    CHECK(status == hal::Status::io_error || status == hal::Status::not_ready);
    static_cast<void>(pwm.read_back());
    std::this_thread::sleep_for(50us);
  }
  wait_for_rounds(*bus, 2);
  LONGS_EQUAL(199, pwm_device->written);
  LONGS_EQUAL(199, pwm.read_back());
  CHECK(good.latest().status == hal::Status::ok);
}

TEST(BusOfDevices, NoticesWhenADeviceComesBack) {
  const auto bus = started(200us);
  wait_for_rounds(*bus, 2);
  bad_device->status = hal::Status::gone;
  wait_for_rounds(*bus, 2);
  CHECK(bad.latest().status == hal::Status::gone);
  bad_device->status = hal::Status::ok;
  wait_for_rounds(*bus, 2);
  CHECK(bad.latest().status == hal::Status::ok);
}

TEST(BusOfDevices, ThatIsTooSlowSkipsPeriodsAndCountsThem) {
  slow.first = slow.then = 3ms;
  const auto bus = started(1ms);
  wait_for_rounds(*bus, 3);
  CHECK(bus->health().skipped.load() >= 6);
  CHECK(bus->health().max_round_ns.load() >= 3'000'000);
}

/// A late round shortens the time to the next one and never lengthens it.
TEST(BusOfDevices, ThatIsFastEnoughIsServedInEveryPeriod) {
  auto bus = started(10ms);
  wait_for_rounds(*bus, 10);
  bus.reset();
  hal::Duration shortest = 1h;
  for (std::size_t i = 1; i < slow.started.size(); ++i)
    shortest = std::min(shortest, slow.started[i] - slow.started[i - 1]);
  CHECK(shortest < 15ms);
}

TEST(BusOfDevices, DoesNotRunFasterThanItsPeriod) {
  const hal::Time start = MonotonicClock::time();
  const auto bus = started(2ms);
  wait_for_rounds(*bus, 5);
  CHECK(MonotonicClock::time() - start >= 4 * 2ms);
}

TEST(BusOfDevices, DoesNotCatchUpSkippedPeriods) {
  slow.first = 30ms;
  auto bus = started(2ms);
  wait_for_rounds(*bus, 6);
  bus.reset();
  // The first of these rounds may itself be late, which shortens the time to the second.
  CHECK(slow.started.at(5) - slow.started.at(1) >= 3 * 2ms);
}

TEST(BusOfDevices, IsNoLongerServedOnceEnded) {
  auto bus = started(200us);
  wait_for_rounds(*bus, 2);
  bus.reset();
  const int reads = good_device->reads;
  std::this_thread::sleep_for(5ms);
  LONGS_EQUAL(reads, good_device->reads);
}

TEST(BusOfDevices, CanBeStartedAndEndedAtOnce) {
  for (int i = 0; i < 50; ++i)
    started(1ms).reset();
}

TEST(BusOfDevices, WithoutItsThreadIsAnError) {
  CHECK_FALSE(BusThread::start({"small", 0, -1, 1}, 1ms, {}).has_value());
}

TEST(BusOfDevices, WithoutAPositivePeriodIsAnError) {
  const auto bus = BusThread::start({"i2c-1"}, 0ns, {});
  STRCMP_EQUAL("a bus's period must be above 0", bus.error().text().c_str());
}

TEST(BusOfDevices, ReportsTheResultOfSettingItsPriority) {
  const auto bus = BusThread::start({"i2c-1", 50, 0}, 1ms, {});
  LONGS_EQUAL(2, (*bus)->steps().size());
}
