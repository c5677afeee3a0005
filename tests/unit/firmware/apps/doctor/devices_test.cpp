// doctor's look at devices, with fake chips and with files instead of drivers. How long calls take
// depends on this machine, so no verdict here depends on it.
#include <algorithm>

#include <CppUTest/TestHarness.h>

#include "apps/supercoil/doctor/check_devices.hpp"
#include "unit/firmware/io/config/support/small_board.hpp"
#include "unit/hal_linux/check/findings.hpp"
#include "unit/hal_linux/support/gpio_kernel.hpp"
#include "unit/hal_linux/support/pwm_kernel.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP(DoctorDevices) {
  // As left behind by a killed firmware: half on.
  PwmKernel pwm{{1'000'000, 500'000, true, false}};
  const hal_linux::Machine machine{pwm.tree / "proc", pwm.tree.path(), pwm.tree / "dev"};
  const std::string adc = "bus/iio/devices/iio:device0/";
  std::string text = small_board_with("{device = \"pwm\", number = 0}",
                                      "{device = \"i2c-1/1-0040\", number = 5, bus = \"i2c-1\"}");
  FakeChip* chip = nullptr;
  std::vector<hal::Finding> findings;
  doctor::BusTimes times;

  void setup() override {
    gpio_kernel() = {};
    pwm.tree.write("dev/gpiochip0", "");
    chip = &gpio_kernel().chips[pwm.tree / "dev/gpiochip0"];
    chip->name = "gpiochip0";
    chip->label = "gpio";
    const std::vector<std::string> names = {"BEAT", "STOP", "EN1"};
    chip->lines.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
      chip->lines[i].name = names[i];
    line("STOP").value = 1;
    pwm.tree.write(adc + "name", "adc\n");
    pwm.tree.write(adc + "in_voltage0_raw", "12000\n");
    pwm.tree.write(adc + "in_voltage1_raw", "1000\n");
    pwm.tree.write(adc + "in_voltage2_raw", "0\n");
    pwm.tree.write(adc + "scan_elements/in_voltage1_type", "le:u16/16>>0\n");
  }
  void teardown() override {
    LONGS_EQUAL(0, gpio_kernel().opened);
  }
  FakeLine& line(const std::string& name) const {
    return *std::find_if(chip->lines.begin(), chip->lines.end(),
                         [&](const FakeLine& l) { return l.name == name; });
  }
  void look() {
    const auto config = config::parse_board_config(text, "b.toml");
    if (!config) FAIL(config::to_text(config.error()).c_str());
    CollectedFindings collected;
    times = doctor::check_devices(*config, machine, 1, collected.sink());
    findings = collected.findings;
  }
  hal::Finding found(const std::string& what) const {
    for (const hal::Finding& finding : findings)
      if (finding.what == what) return finding;
    FAIL(("nothing was found of " + what).c_str());
    return {};
  }
  void check_found(const std::string& what, const std::string& part) const {
    STRCMP_CONTAINS(part.c_str(), found(what).found.c_str());
  }
  long times_in(const std::string& name, const std::string& event) const {
    const auto& history = line(name).history;
    return std::count(history.begin(), history.end(), event);
  }
};

TEST(DoctorDevices, AreAllReported) {
  look();
  std::string names;
  for (const hal::Finding& finding : findings)
    names += finding.what + "; ";
  STRCMP_EQUAL(
      "heartbeat; stop_circuit; channel 1, enable; channel 1, enable released; channel 1, pwm; "
      "supply; channel 1, position; channel 1, current; ",
      names.c_str());
  check_found("heartbeat", "BEAT of gpio, low; ");
  check_found("stop_circuit", "STOP of gpio: closed; ");
  check_found("channel 1, enable", "EN1 of gpio, low; ");
  check_finding("warning", "low while undriven", "a resistor", found("channel 1, enable released"));
  check_finding("ok",
                "output 5 of i2c-1/1-0040 took its period of 1000000 ns, not inversed, duty 0", "",
                found("channel 1, pwm"));
  check_found("supply", ": 12 to 12 V, ");
}

TEST(DoctorDevices, AreNeverSwitchedOnAndLeftOff) {
  look();
  CHECK_FALSE(pwm.state.enabled);
  LONGS_EQUAL(0, pwm.state.duty_ns);
  // Off in every state that doctor set.
  DOUBLES_EQUAL(0.0, pwm.max_on, 0.0);
  for (const std::string& write : pwm.writes)
    CHECK(!write.starts_with("duty_cycle") || write == "duty_cycle 0");
  for (const char* name : {"BEAT", "EN1"}) {
    LONGS_EQUAL(0, times_in(name, "set 1"));
    STRCMP_EQUAL("output 0", line(name).history.front().c_str());
    STRCMP_EQUAL("release", line(name).history.back().c_str());
    LONGS_EQUAL(0, line(name).value);
  }
  LONGS_EQUAL(0, times_in("BEAT", "input"));
  LONGS_EQUAL(1, times_in("EN1", "input"));
}

TEST(DoctorDevices, AnEnableIsNotReleasedBeforeItsDutyIsZero) {
  text = small_board_with("{device = \"pwm\", number = 0}",
                          "{device = \"i2c-1/1-0041\", number = 5, bus = \"i2c-1\"}");
  look();
  check_finding("problem", "no PWM chip whose path ends with 'i2c-1/1-0041'", "load",
                found("channel 1, pwm"));
  check_finding("warning", "not checked: its duty may not be 0", "channel 1, pwm",
                found("channel 1, enable released"));
  LONGS_EQUAL(0, times_in("EN1", "input"));
  // Only a part of a bus's time would look too good.
  CHECK(times.empty());
}

TEST(DoctorDevices, AnOpenStopCircuitIsAWarning) {
  line("STOP").value = 0;
  look();
  check_finding("warning", "STOP of gpio: open", "close it", found("stop_circuit"));
}

TEST(DoctorDevices, LinesThatFailAreProblems) {
  line("EN1").consumer = "fan";
  look();
  check_finding("problem", "which 'fan' holds", "gpioinfo", found("channel 1, enable"));
  for (const hal::Finding& finding : findings)
    CHECK(finding.what != "channel 1, enable released");
}

TEST(DoctorDevices, ConvertersAtARailOutOfRangeOrBrokenAreProblems) {
  pwm.tree.write(adc + "in_voltage0_raw", "9000\n");
  pwm.tree.write(adc + "in_voltage1_raw", "65535\n");
  pwm.tree.write(adc + "in_voltage2_raw", "501\n");
  look();
  check_finding("problem", ": 9 to 9 V, noise 0 V rms, 50 readings: must be 10.8 to 13.2 V",
                "switch it on", found("supply"));
  check_finding("problem", "all of them 65535 counts: stuck at the converter's highest rail",
                "the position's sensor", found("channel 1, position"));
  check_finding("problem", "50.1 mA", "nothing is driven", found("channel 1, current"));
  pwm.tree.remove(adc + "in_voltage2_raw");
  look();
  check_finding("problem", "no input 'voltage2' on iio:device0 'adc' at ", "load",
                found("channel 1, current"));
}

TEST(DoctorDevices, BusTimeIsTheSumOfItsDevices) {
  look();
  // Only the PWM is on the bus.
  LONGS_EQUAL(1, times.size());
  CHECK(times.at("i2c-1").count() > 0);
}

TEST(DoctorDevices, TheAirSensorMustReadWithinTheConfiguredAir) {
  // Buffered, because a direct converter with slow calls would be a problem whatever the air.
  text = small_board_with("warmest_C = 30\n",
                          "warmest_C = 30\nsensor = {device = 'adc', input = 'voltage3', "
                          "C_per_count = 0.01, bus = 'i2c-1'}\n");
  pwm.tree.write(adc + "in_voltage3_raw", "3100\n");
  look();
  check_finding("ok", ": 31 to 31 °C, ", "", found("air"));
  pwm.tree.write(adc + "in_voltage3_raw", "3300\n");
  look();
  check_finding("problem", ": must be 13 to 32 °C", "compare it with a thermometer", found("air"));
  pwm.tree.remove(adc + "in_voltage3_raw");
  look();
  check_finding("problem", "no input 'voltage3' on iio:device0 'adc' at ", "load", found("air"));
}
