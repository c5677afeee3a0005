#include "telemetry/publisher.hpp"

#include <initializer_list>
#include <vector>

#include <supercoil.h>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/telemetry/support/test_bus.hpp"

using namespace supercoil;
using namespace supercoil::telemetry;
using namespace std::chrono_literals;

namespace {

CanSettings only(Message message, double rate_Hz) {
  CanSettings settings;
  settings.rates_Hz = {};
  settings.rates_Hz[static_cast<std::size_t>(message)] = rate_Hz;
  settings.queue = 8;
  settings.first_node = 5;
  return settings;
}

Row row_at(hal::Time time, Fault fault = Fault::none) {
  Row row{};
  row.time_ns = time.count();
  row.fault = static_cast<std::uint8_t>(fault);
  row.position_m = static_cast<float>(1e-6 * static_cast<double>(time / 1ms));
  return row;
}

int micrometres(const hal::CanFrame& frame) {
  supercoil_measurement_t m{};
  supercoil_measurement_unpack(&m, frame.data.data(), frame.length);
  return m.position_m / 10;
}

}  // namespace

TEST_GROUP(Publisher) {
  test::TestBus bus;
  LoopTiming timing;

  /// One row per millisecond.
  void publish(Publisher & publisher, int from_ms, int to_ms) {
    for (int ms = from_ms; ms < to_ms; ++ms) {
      publisher.offer(row_at(ms * 1ms));
      publisher.poll(ms * 1ms, [](std::uint8_t) { return false; });
    }
  }
};

TEST(Publisher, SendsTheNewestRowAtItsRateFromItsNode) {
  Publisher publisher(only(Message::measurement, 100.0), {1, ChannelSettings()}, timing, bus);
  publish(publisher, 0, 1000);
  LONGS_EQUAL(100, bus.sent.size());
  LONGS_EQUAL(0x280 + 5, bus.sent[0].id);
  LONGS_EQUAL(10, micrometres(bus.sent[50]) - micrometres(bus.sent[49]));
}

TEST(Publisher, ParametersTakeTurnsAndUnknownOnesAreOmitted) {
  Publisher publisher(only(Message::estimate, 1000.0), {1, ChannelSettings()}, timing, bus);
  int expected = 0;
  const auto check_cycle = [&](int from_ms, bool reported, int all) {
    bus.sent.clear();
    for (int ms = from_ms; ms < from_ms + 30; ++ms) {
      Row row = row_at(ms * 1ms);
      for (std::uint8_t place = 1; reported && place <= 6; ++place) {
        row.multiplexed_selector = place;
        row.multiplexed_value = 0.5F;
        publisher.offer(row);
      }
      publisher.offer(row);
      publisher.poll(ms * 1ms, [](std::uint8_t) { return false; });
    }
    CHECK(bus.sent.size() >= 28);
    for (const hal::CanFrame& frame : bus.sent) {
      expected = (expected + 1) % all;
      LONGS_EQUAL(expected, frame.data[0]);
    }
  };
  check_cycle(0, true, 14);
  CHECK(expected < 8);
  check_cycle(30, false, 8);
  check_cycle(60, true, 14);
}

TEST(Publisher, OnABusyBusQueuesDropsTheOldestAndCounts) {
  test::TestBus free;
  Publisher twin(only(Message::measurement, 1000.0), {1, ChannelSettings()}, timing, free);
  publish(twin, 0, 20);
  const std::size_t dropped = free.sent.size() - 8;
  Publisher publisher(only(Message::measurement, 1000.0), {1, ChannelSettings()}, timing, bus);
  bus.answer = hal::Status::busy;
  publish(publisher, 0, 20);
  LONGS_EQUAL(0, bus.sent.size());
  LONGS_EQUAL(8, publisher.waiting());
  LONGS_EQUAL(dropped, publisher.dropped());
  bus.answer = hal::Status::ok;
  publish(publisher, 20, 21);
  // The newest eight of the waiting frames and the new one, in order.
  LONGS_EQUAL(9, bus.sent.size());
  LONGS_EQUAL(20, micrometres(bus.sent.back()));
  LONGS_EQUAL(12, micrometres(bus.sent.front()));
  LONGS_EQUAL(dropped, publisher.dropped());
  LONGS_EQUAL(0, publisher.waiting());
}

TEST(Publisher, MessagesQueuedForALostBusAreDropped) {
  Publisher publisher(only(Message::measurement, 1000.0), {1, ChannelSettings()}, timing, bus);
  bus.answer = hal::Status::gone;
  publish(publisher, 0, 20);
  bus.answer = hal::Status::ok;
  publish(publisher, 20, 21);
  LONGS_EQUAL(1, bus.sent.size());
  LONGS_EQUAL(20, micrometres(bus.sent[0]));
  CHECK(publisher.dropped() >= 19);
}

TEST(Publisher, AFaultIsSentAtOnceAndBeforeQueuedMessages) {
  Publisher publisher(only(Message::measurement, 1000.0), {1, ChannelSettings()}, timing, bus);
  bus.answer = hal::Status::busy;
  publish(publisher, 0, 20);
  publisher.offer(row_at(20ms, Fault::over_travel));
  bus.answer = hal::Status::ok;
  publisher.poll(20ms, [](std::uint8_t) { return false; });
  LONGS_EQUAL(0x080 + 5, bus.sent.at(0).id);
  LONGS_EQUAL(31, bus.sent[0].data[0]);
  // Sent once, and again after a reset.
  bus.sent.clear();
  publisher.offer(row_at(21ms, Fault::over_travel));
  publisher.offer(row_at(22ms));
  publisher.poll(22ms, [](std::uint8_t) { return false; });
  LONGS_EQUAL(2, bus.sent.size());
  LONGS_EQUAL(0x080 + 5, bus.sent[0].id);
  LONGS_EQUAL(0, bus.sent[0].data[0]);
}

TEST(Publisher, FallsSilentWhenTheLoopStalls) {
  Publisher publisher(only(Message::status, 10.0), {1, ChannelSettings()}, timing, bus);
  publish(publisher, 0, 1000);
  const std::size_t sent = bus.sent.size();
  for (int ms = 1000; ms < 2000; ++ms)
    publisher.poll(ms * 1ms, [](std::uint8_t) { return false; });
  CHECK(bus.sent.size() <= sent + 1);
}

TEST(Publisher, SendsTheMaxTimesSinceTheLastMessage) {
  Publisher publisher(only(Message::timing, 10.0), {1, ChannelSettings()}, timing, bus);
  timing.add({30us, 5us}, 0);
  timing.add({20us, 8us}, 2);
  publish(publisher, 0, 150);
  supercoil_timing_t m{};
  supercoil_timing_unpack(&m, bus.sent.at(0).data.data(), 8);
  LONGS_EQUAL(300, m.late_s);
  LONGS_EQUAL(80, m.execution_s);
  LONGS_EQUAL(2, m.overruns);
  publish(publisher, 150, 250);
  supercoil_timing_unpack(&m, bus.sent.at(1).data.data(), 8);
  LONGS_EQUAL(0xFFFFF, m.late_s);  // no tick since
}

/// Three channels: a single muscle, and a joint whose agonist is the last channel.
TEST(Publisher, SendsTheJointsPartsInTurnFromTheAgonistsNode) {
  std::vector<ChannelSettings> channels(3);
  channels[2].joint = {.direction = 1, .lever = control::Lever(0.02), .other_channel_offset = -1};
  channels[1].joint = {.direction = -1, .lever = control::Lever(0.02), .other_channel_offset = 1};
  Publisher publisher(only(Message::joint, 1000.0), channels, timing, bus);
  const auto publish_to = [&](int ms, std::initializer_list<std::uint8_t> reported) {
    for (const std::uint8_t channel : reported) {
      Row row = row_at(ms * 1ms);
      row.channel = channel;
      row.position_m = 0.002F;
      row.hottest_C = static_cast<float>(20 + channel);
      publisher.offer(row);
    }
    publisher.poll(ms * 1ms, [](std::uint8_t) { return false; });
  };
  const auto joint_of = [&](const hal::CanFrame& frame) {
    LONGS_EQUAL(0x780 + 5 + 2, frame.id);
    supercoil_joint_t m{};
    LONGS_EQUAL(0, supercoil_joint_unpack(&m, frame.data.data(), frame.length));
    return m;
  };
  // There is no row of the antagonist yet.
  for (int ms = 0; bus.sent.size() < 6; ++ms)
    publish_to(ms, {0, 2});
  LONGS_EQUAL(-32768, joint_of(bus.sent[4]).antagonist_hottest_c);
  bus.sent.clear();
  for (int ms = 100; ms < 112; ++ms)
    publish_to(ms, {0, 1, 2});
  CHECK(bus.sent.size() >= 11);
  for (std::size_t i = 0; i < bus.sent.size(); ++i) {
    const auto m = joint_of(bus.sent[i]);
    LONGS_EQUAL(i % 6, m.part);
    DOUBLES_EQUAL(0.1 * 180.0 / 3.14159265, supercoil_joint_angle_deg_decode(m.angle_deg), 3e-4);
    if (m.part == 2) LONGS_EQUAL(2200, m.agonist_hottest_c);
    if (m.part == 4) LONGS_EQUAL(2100, m.antagonist_hottest_c);
  }
}

TEST(Publisher, SendsFourPartsForAMuscleAgainstASpring) {
  std::vector<ChannelSettings> channels(1);
  channels[0].joint = {.direction = 1};
  Publisher publisher(only(Message::joint, 1000.0), channels, timing, bus);
  publish(publisher, 0, 20);
  CHECK(bus.sent.size() >= 19);
  for (std::size_t i = 0; i < bus.sent.size(); ++i)
    LONGS_EQUAL(i % 4, bus.sent[i].data[0] & 0xFU);
}

TEST(Publisher, SendsEmergenciesThenAnswersThenQueuedMessages) {
  Publisher publisher(only(Message::measurement, 100.0), {1, ChannelSettings()}, timing, bus);
  bus.answer = hal::Status::busy;
  publish(publisher, 0, 50);
  hal::CanFrame answer;
  answer.id = 0x245;
  publisher.send(answer);
  publisher.offer(row_at(50ms, Fault::heater_open));
  // However many answers wait, they do not displace an emergency.
  for (int i = 0; i < 100; ++i)
    publisher.send(answer);
  bus.answer = hal::Status::ok;
  publisher.poll(51ms, [](std::uint8_t) { return false; });
  LONGS_EQUAL(0x080 + 5, bus.sent[0].id);
  for (std::size_t i = 1; i <= 32; ++i)
    LONGS_EQUAL(0x245, bus.sent[i].id);
  LONGS_EQUAL(0x280 + 5, bus.sent[33].id);
}
