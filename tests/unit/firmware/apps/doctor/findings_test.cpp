// doctor's findings about calls, lines and buses.
#include "unit/hal_linux/check/findings.hpp"

#include <ctime>

#include <CppUTest/TestHarness.h>

#include "apps/supercoil/doctor/call_time.hpp"
#include "apps/supercoil/doctor/check_devices.hpp"

using namespace supercoil;
using namespace supercoil::doctor;
using namespace supercoil::test;
using namespace std::chrono_literals;

TEST_GROUP(DoctorFindings){static hal::Finding direct(hal::Duration p99, bool real_time){
    return assess("heartbeat", "GPIO17 of soc", {3us, p99, 90us, 200, 0, real_time},
                  "use another line");
}
static hal::Finding released(bool high, hal_linux::Bias bias,
                             hal::Status status = hal::Status::ok) {
  return assess("channel 1, enable released", {{high, status}, bias});
}
static hal::Finding bus(const BusTimes& measured, double rate_Hz = 100.0) {
  config::BoardConfig config;
  config.settings.rate_Hz = rate_Hz;
  // 3 transactions of (9 x 5 + 2) / 100 kHz + 30 us: 1.5 ms.
  config.wiring.buses.push_back({"i2c-1", config::BusKind::i2c, 100e3, 30e-6});
  config.wiring.supply.access = {"i2c-1", 3, 5, 0.0};
  CollectedFindings collected;
  check_buses(config, measured, collected.sink());
  LONGS_EQUAL(1, collected.findings.size());
  return collected.findings.front();
}
}
;

TEST(DoctorFindings, ADirectCallMayTakeAtMost20Us) {
  check_finding(
      "ok", "GPIO17 of soc; 3.0 us on average, 99 % within 20.0 us, 90.0 us at most, of 200 calls",
      "", direct(20us, true));
  check_finding("problem", "99 % within 20.0 us, 90.0 us at most, of 200 calls: more than 20.0 us",
                "use another line", direct(20us + 1ns, true));
  check_finding("warning", "(without real-time priority): more than", "measure with",
                direct(21us, false));
}

TEST(DoctorFindings, InterruptedCallsAreNotHeldAgainstTheDevice) {
  const CallTime some{3us, 4us, 8us, 200, 7, true};
  check_finding("ok", "8.0 us at most, of 200 calls, 7 interrupted", "",
                assess("light", "GPIO3 of soc", some, "use another line"));
  const CallTime all{0us, 0us, 0us, 0, 200, true};
  check_finding("warning", "cannot be timed", "stop other programs",
                assess("light", "GPIO3 of soc", all, "use another line"));
}

TEST(DoctorFindings, CallsAreTimedIndividually) {
  // Slow once, as when the kernel interrupts it; slow now and then, as a bus is.
  for (const int every : {150, 40}) {
    int calls = 0;
    const auto call = [&] {
      if (++calls % every != 0) return;
      const timespec long_one{0, 2'000'000};
      nanosleep(&long_one, nullptr);
    };
    const CallTime time = time_calls(call, 50);
    LONGS_EQUAL(200, time.calls);
    CHECK(time.worst >= 2ms);
    CHECK(time.mean < time.worst / 2);
    CHECK_EQUAL(every == 40, time.p99 >= 2ms);
  }
}

TEST(DoctorFindings, AnEnablePulledUpIsAProblem) {
  using hal_linux::Bias;
  for (const Bias bias : {Bias::unknown, Bias::none, Bias::pull_up, Bias::pull_down}) {
    check_finding("problem", "high while undriven; ", "pulls it down", released(true, bias));
  }
  check_finding("ok", "low while undriven; the chip pulls it down", "",
                released(false, Bias::pull_down));
  for (const Bias bias : {Bias::unknown, Bias::none, Bias::pull_up})
    check_finding("warning", "low while undriven; ", "a resistor", released(false, bias));
  check_finding("warning", "cannot be read", "a resistor",
                released(false, Bias::pull_down, hal::Status::io_error));
}

TEST(DoctorFindings, BusTimeIsComparedWithItsConfiguration) {
  check_finding("ok", "1.500 ms (15.0 % of a tick) by the configuration; not measured", "",
                bus({}));
  check_finding("ok", "by the configuration, 1.800 ms (18.0 % of a tick) measured", "",
                bus({{"i2c-1", 1800us}}));
  check_finding("warning", "1.900 ms", "clock_Hz", bus({{"i2c-1", 1900us}}));
  check_finding("problem", "7.100 ms (71.0 % of a tick) measured: the limit is 70 %",
                "fewer devices", bus({{"i2c-1", 7100us}}));
}
