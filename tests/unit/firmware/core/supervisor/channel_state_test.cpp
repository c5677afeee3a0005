#include "supervisor/channel_state.hpp"

#include <string>
#include <utility>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

using namespace supercoil;

namespace {

ChannelState active() {
  ChannelState channel;
  channel.arm();
  channel.activate();
  return channel;
}

}  // namespace

TEST_GROUP(ChannelState){};

TEST(ChannelState, BootsDisarmedAndCold) {
  const ChannelState channel;
  CHECK(channel.state() == State::disarmed);
  CHECK_FALSE(channel.enable());
  CHECK_FALSE(channel.may_heat());
}

TEST(ChannelState, HeatsOnlyWhenActive) {
  ChannelState channel;
  CHECK(channel.activate() == Refusal::wrong_state);
  CHECK(channel.arm() == Refusal::none);
  CHECK(channel.enable());
  CHECK_FALSE(channel.may_heat());
  CHECK(channel.activate() == Refusal::none);
  CHECK(channel.may_heat());
  CHECK(channel.rest() == Refusal::none);
  CHECK_FALSE(channel.may_heat());
}

// The refusals' numbers are sent on the bus.
TEST(ChannelState, EveryRefusalHasItsName) {
  for (const auto& [refusal, text] :
       {std::pair{Refusal::none, "none"}, std::pair{Refusal::wrong_state, "wrong_state"},
        std::pair{Refusal::cause_persists, "cause_persists"},
        std::pair{Refusal::no_edge, "no_edge"}, std::pair{Refusal::not_ready, "not_ready"},
        std::pair{Refusal::busy, "busy"}, std::pair{Refusal::out_of_range, "out_of_range"},
        std::pair{Refusal::no_such_channel, "no_such_channel"},
        std::pair{Refusal::not_lease_holder, "not_lease_holder"},
        std::pair{Refusal::no_lease, "no_lease"},
        std::pair{Refusal::wrong_counter, "wrong_counter"},
        std::pair{Refusal::queue_full, "queue_full"},
        std::pair{Refusal::claim_again, "claim_again"},
        std::pair{Refusal::protocol_mismatch, "protocol_mismatch"},
        std::pair{Refusal::unsuitable, "unsuitable"},
        std::pair{Refusal::infeasible, "infeasible"}}) {
    CHECK(static_cast<std::size_t>(refusal) < refusal_names.size());
    STRCMP_EQUAL(text, std::string(name(refusal)).c_str());
  }
}

TEST(ChannelState, KeepsItsFirstCause) {
  ChannelState channel = active();
  channel.disarm(Fault::over_temperature);
  channel.disarm(Fault::heater_open);
  channel.disarm(Fault::none);
  CHECK(channel.state() == State::fault);
  CHECK(channel.first_cause() == Fault::over_temperature);
  CHECK_FALSE(channel.enable());
}

TEST(ChannelState, OrdinaryStopIsNotAFault) {
  ChannelState channel = active();
  channel.disarm(Fault::none);
  CHECK(channel.state() == State::disarmed);
}

TEST(ChannelState, LeavesFaultOnlyOnAnEdgeAfterTheCauseIsGone) {
  ChannelState channel = active();
  channel.disarm(Fault::heater_short);
  CHECK(channel.arm() == Refusal::wrong_state);
  CHECK(channel.reset(true, false) == Refusal::no_edge);  // high from the start
  CHECK(channel.reset(false, false) == Refusal::no_edge);
  CHECK(channel.reset(true, true) == Refusal::cause_persists);
  CHECK(channel.reset(true, false) == Refusal::no_edge);  // held, not pressed again
  CHECK(channel.state() == State::fault);
  channel.reset(false, false);
  CHECK(channel.reset(true, false) == Refusal::none);
  CHECK(channel.state() == State::disarmed);
  CHECK(channel.first_cause() == Fault::none);
}

TEST(ChannelState, NeverHeatsWithoutArmAndActivate) {
  CHECK(rc::check("random commands", [] {
    ChannelState channel;
    bool armed_since = false;  // from the commands alone, independently of the state
    bool active_since = false;
    for (const int command : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 7))) {
      switch (command) {
        case 0:
          if (channel.arm() == Refusal::none) armed_since = true;
          break;
        case 1:
          if (channel.activate() == Refusal::none) {
            RC_ASSERT(armed_since);
            active_since = true;
          }
          break;
        case 2:
          if (channel.rest() == Refusal::none) active_since = false;
          break;
        case 3:
          channel.disarm(Fault::none);
          armed_since = active_since = false;
          break;
        case 4:
          channel.disarm(Fault::over_travel);
          armed_since = active_since = false;
          break;
        default:
          channel.reset(command == 5, false);
          break;
      }
      RC_ASSERT(channel.may_heat() == active_since);
      RC_ASSERT(channel.enable() == armed_since);
      RC_ASSERT((channel.state() == State::fault) == (channel.first_cause() != Fault::none));
    }
  }));
}
