// The same for lines, converters, buses, captures and CAN: used twice, too slow or missing.
#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/config/support/checked_board.hpp"

using supercoil::test::check_problems;
using supercoil::test::check_replaced;
using supercoil::test::small_board;

TEST_GROUP(WrongWiring){};

TEST(WrongWiring, LineGivenTwice) {
  check_replaced("EN1", "STOP",
                 "b.toml:20: channel[1].enable.line = 'STOP': is already the stop circuit: line "
                 "STOP of gpio");
}

TEST(WrongWiring, ConverterInputGivenTwice) {
  check_replaced("voltage2", "voltage1",
                 "b.toml:30: channel[1].current.input = 'voltage1': is already channel 1's "
                 "position: input voltage1 of adc");
}

TEST(WrongWiring, PwmOutputGivenTwice) {
  const std::string other = small_board.substr(small_board.find("[[channel]]"));
  std::string text = small_board + other;
  const auto replace_last = [&text](const std::string& old, const std::string& replacement) {
    text.replace(text.rfind(old), old.size(), replacement);
  };
  replace_last("EN1", "EN2");
  replace_last("voltage1", "voltage3");
  replace_last("voltage2", "voltage4");
  check_problems(
      "b.toml:44: channel[2].pwm.number = 0: is already channel 1's PWM: output 0 of pwm", text);
}

TEST(WrongWiring, BufferedHeartbeat) {
  check_replaced(
      "line = \"BEAT\"", "line = \"BEAT\", buffered = true",
      "b.toml:5: lines.heartbeat.buffered = true: must be false: lines are direct (20 us "
      "or less), because they, not the duty, are the timed cut");
}

TEST(WrongWiring, BufferedWithoutABus) {
  check_replaced("number = 0", "number = 0, buffered = true",
                 "b.toml:21: channel[1].pwm.buffered = true: needs bus = \"…\"");
  check_replaced("number = 0", "number = 0, bus = 'i2c-7'",
                 "b.toml:21: channel[1].pwm.bus = 'i2c-7': is not the name of a [[bus]]");
  check_replaced("number = 0", "number = 0, bus = 'i2c-1', buffered = false",
                 "b.toml:21: channel[1].pwm.buffered = false: must be true: devices on a bus are "
                 "served by its thread");
}

TEST(WrongWiring, PumpThatDecaysWithinToleratedOverruns) {
  check_replaced("charge_pump_decay_ms = 20", "charge_pump_decay_ms = 8",
                 "b.toml:2: board.charge_pump_decay_ms = 8: must exceed twice the tolerated "
                 "overruns: 5 in a row at 1000 Hz are 5 ms, so more than 10 ms, not 8");
}

TEST(WrongWiring, TooSlowABus) {
  check_replaced("voltage1\"", "voltage1\"\nbus = 'i2c-1'\nwait_ms = 1.2",
                 "b.toml:11: bus[1].name = 'i2c-1': the bus would be busy for 1.34 ms of a tick of "
                 "1 ms (134 %); the limit is 70 %");
}

TEST(WrongWiring, BusTimeOfADirectDevice) {
  check_replaced("voltage1\"", "voltage1\"\nwait_ms = 1.2",
                 "b.toml:25: channel[1].position.wait_ms = 1.2: is for buffered devices: needs bus "
                 "= \"…\"");
}

TEST(WrongWiring, MaxAgeBelowThatOfABufferedValue) {
  check_replaced("voltage1\"", "voltage1\"\nbus = 'i2c-1'\nmax_age_ms = 0.5",
                 "b.toml:26: channel[1].position.max_age_ms = 0.5: must be at least one tick: a "
                 "buffered value becomes older than that before the next one arrives");
}

TEST(WrongWiring, CaptureOfSomeInputsOfADevice) {
  check_replaced("input = \"voltage1\"", "input = \"voltage1\"\ncapture = {trigger = 'clock'}",
                 "b.toml:23: channel[1].position.device = 'adc': has another input with another "
                 "capture: all its inputs are converted together, and none can be read separately");
}

TEST(WrongWiring, CaptureBehindABus) {
  check_replaced(
      "device = \"adc\"\ninput = \"voltage1\"",
      "device = \"fast\"\ninput = \"voltage1\"\nbus = 'i2c-1'\ncapture = {trigger = 'clock', "
      "length = 1}",
      "b.toml:25: channel[1].position.bus = 'i2c-1': and capture exclude each other: the kernel "
      "reads, not a bus's thread\n"
      "b.toml:26: channel[1].position.capture.length = 1: must be 2 to 65536");
}

TEST(WrongWiring, OverloadedCanBus) {
  check_problems(
      "b.toml:43: can.bit_rate = 50000: the bus would be busy for 90 % by messages sent at "
      "a rate; the limit is 50 % (max_load): choose lower rates",
      small_board + "[can]\nbit_rate = 50000\n");
}

TEST(WrongWiring, InvalidCanNodes) {
  check_problems("b.toml:43: can.first_node = 64: must be 1 to 63",
                 small_board + "[can]\nfirst_node = 64\n");
}

TEST(WrongWiring, InvalidCanRates) {
  check_problems("b.toml:43: can.rates.status_Hz = 0: must be 1 to 1000",
                 small_board + "[can]\nrates = {status_Hz = 0}\n");
  check_problems(
      "b.toml:43: can.rates.powr_Hz = 10: is not a key of [can.rates]; did you mean "
      "power_Hz?",
      small_board + "[can]\nrates = {powr_Hz = 10}\n");
}

TEST(WrongWiring, InvalidInterfaceName) {
  check_problems(
      "b.toml:43: can.interface = 'a-name-of-16-char': must be a name of 1 to 15 characters",
      small_board + "[can]\ninterface = 'a-name-of-16-char'\n");
}

TEST(WrongWiring, AirSensorWithoutAScaleOrWithAUsedInput) {
  check_replaced(
      "warmest_C = 30\n", "warmest_C = 30\n[ambient.sensor]\ndevice = 'adc'\ninput = 'voltage3'\n",
      "b.toml:10: ambient.sensor.C_per_count: is missing: it must be a number, -10 to 10");
  check_replaced("warmest_C = 30\n",
                 "warmest_C = 30\nsensor = {device = 'adc', input = 'voltage3', C_per_count = 0}\n",
                 "b.toml:10: ambient.sensor.C_per_count = 0: must not be 0");
  check_replaced("warmest_C = 30\n",
                 "warmest_C = 30\nsensor = {device = 'adc', input = 'voltage0', C_per_count = 1}\n",
                 "b.toml:10: ambient.sensor.input = 'voltage0': is already the supply: input "
                 "voltage0 of adc");
}
