#include "telemetry/schedule.hpp"

#include <map>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace supercoil::telemetry;
using namespace std::chrono_literals;

namespace {

/// The number of frames in each millisecond.
std::vector<int> frames_per_ms(Schedule& schedule, int milliseconds) {
  std::vector<int> counts;
  for (int ms = 0; ms < milliseconds; ++ms) {
    counts.push_back(0);
    schedule.due(ms * 1ms, [&](std::uint8_t, Message) { ++counts.back(); });
  }
  return counts;
}

}  // namespace

TEST_GROUP(Schedule){};

TEST(Schedule, SendsEachMessageOfEachChannelAtItsRate) {
  Rates rates = default_rates();
  rates[static_cast<std::size_t>(Message::power)] = 0.0;
  rates[static_cast<std::size_t>(Message::heater)] = 3.0;
  Schedule schedule(std::vector<Rates>(4, rates));
  std::map<std::pair<int, Message>, int> counts;
  for (int ms = 0; ms < 100'000; ++ms) {
    schedule.due(ms * 1ms, [&](std::uint8_t channel, Message message) {
      ++counts[{channel, message}];
    });
  }
  for (int channel = 0; channel < 4; ++channel) {
    for (std::size_t i = 0; i < messages; ++i) {
      const bool sent = channel == 0 || !periodic_messages()[i].of_board;
      const double expected = sent ? 100.0 * rates[i] : 0.0;
      DOUBLES_EQUAL(expected, (counts[{channel, static_cast<Message>(i)}]), 1.0);
    }
  }
}

/// As docs/can.md says about supercoild's rounds of 5 ms and the simulated board's ticks of 1 ms.
TEST(Schedule, SendsAMessageAtMostOncePerPoll) {
  Rates rates = default_rates();
  rates[static_cast<std::size_t>(Message::measurement)] = 1000.0;
  for (const auto& [every, expected] : {std::pair{5, 2000}, std::pair{1, 10'000}}) {
    Schedule schedule({rates});
    int count = 0;
    for (int ms = 0; ms < 10'000; ms += every) {
      schedule.due(ms * 1ms, [&](std::uint8_t, Message message) {
        count += message == Message::measurement ? 1 : 0;
      });
    }
    DOUBLES_EQUAL(expected, count, 2);
  }
}

TEST(Schedule, HasNoBursts) {
  for (const std::size_t channels : {1U, 2U, 4U, 8U, 16U}) {
    Schedule schedule(std::vector<Rates>(channels, default_rates()));
    const auto counts = frames_per_ms(schedule, 2000);
    double sum = 0.0;
    for (const int count : counts)
      sum += count;
    const double mean = sum / static_cast<double>(counts.size());
    const int max = *std::max_element(counts.begin(), counts.end());
    CHECK_TEXT(max <= mean + 3.0, std::to_string(max).c_str());
  }
}

TEST(Schedule, DoesNotCatchUpMissedMessages) {
  Schedule schedule({default_rates()});
  frames_per_ms(schedule, 1000);
  int sent = 0;
  const auto count = [&](std::uint8_t, Message) { ++sent; };
  schedule.due(60s, count);
  CHECK(sent <= static_cast<int>(messages));
  sent = 0;
  schedule.due(60s, count);
  LONGS_EQUAL(0, sent);
}

TEST(Schedule, CountsTheWorstCaseBitsOfAFrame) {
  // Davis et al. 2007: 55 to 135 bits of frames with 11-bit identifiers.
  LONGS_EQUAL(55, max_bits(0));
  LONGS_EQUAL(135, max_bits(8));
}

/// Nodes without a joint keep their load and the places of their messages.
TEST(Schedule, OnlyTheJointsNodeSendsIt) {
  CanSettings can;
  can.rates_Hz = {};
  can.rates_Hz[static_cast<std::size_t>(Message::joint)] = 50.0;
  std::vector<ChannelSettings> channels(3);
  const double boot = bus_load(can, channels);
  DOUBLES_EQUAL(3 * 135.0 / 500e3, boot, 1e-12);
  Schedule none(rates_of(can, channels));
  for (const int count : frames_per_ms(none, 1000))
    LONGS_EQUAL(0, count);
  channels[1].joint.direction = -1;
  channels[2].joint.direction = 1;
  DOUBLES_EQUAL(50 * 135.0 / 500e3, bus_load(can, channels) - boot, 1e-12);
  Schedule schedule(rates_of(can, channels));
  int sent = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    schedule.due(ms * 1ms, [&](std::uint8_t channel, Message message) {
      LONGS_EQUAL(2, channel);
      CHECK(message == Message::joint);
      ++sent;
    });
  }
  LONGS_EQUAL(50, sent);
}

TEST(Schedule, ReportsTheLoadOfTheBus) {
  Rates rates{};
  rates[static_cast<std::size_t>(Message::measurement)] = 100.0;
  rates[static_cast<std::size_t>(Message::timing)] = 10.0;
  // 4 channels x 100 x 135 + 10 x 135 bits, as the board's timing is sent once, and 4 x 135 for
  // Boot.
  DOUBLES_EQUAL(55890.0 / 500e3, bus_load(std::vector<Rates>(4, rates), 500e3), 1e-12);
}
