// Requests to a node over a bus that loses frames.
#include "apps/supercoil/bus/commander.hpp"

#include <deque>

#include <CppUTest/TestHarness.h>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "telemetry/opcodes.hpp"

using namespace supercoil;
using operating::Commander;

namespace {

constexpr std::uint8_t node = 3;

/// The board behind it reports 0.5 for every quantity of its muscle; the first requests are lost.
class LossyBus final : public hal::CanBus {
 public:
  explicit LossyBus(int lost) : lost_(lost) {}

  hal::Status send(const hal::CanFrame& frame) override {
    if (--lost_ >= 0) return hal::Status::ok;
    const can::Reader<can::message::muscle_read> asked(frame);
    answers_.push_back(can::Encoder<can::message::muscle>(node)
                           .set("quantity", asked.get<std::uint8_t>("quantity"))
                           .set("value", 0.5)
                           .frame());
    return hal::Status::ok;
  }
  hal::Status receive(hal::CanFrame& frame) override {
    if (answers_.empty()) return hal::Status::not_ready;
    frame = answers_.front();
    answers_.pop_front();
    return hal::Status::ok;
  }
  hal::CanState state() const override { return hal::CanState::active; }

 private:
  int lost_;
  std::deque<hal::CanFrame> answers_;
};

/// The board behind it obeys every command; the first ones, except claims, are lost.
class LossyCommands final : public hal::CanBus {
 public:
  /// heard counts the commands, lost ones included, but no claims.
  LossyCommands(int lost, int& heard) : lost_(lost), heard_(heard) {}

  hal::Status send(const hal::CanFrame& frame) override {
    const can::Reader<can::message::command> asked(frame);
    const bool claims = asked.get<std::uint8_t>("opcode") == telemetry::lease;
    if (!claims && ++heard_ <= lost_) return hal::Status::ok;
    answers_.push_back(can::Encoder<can::message::acknowledge>(node)
                           .set("counter", asked.get("counter"))
                           .set("opcode", asked.get("opcode"))
                           .set("session", asked.get("session"))
                           .set("granted", 0x4321)
                           .protected_frame());
    return hal::Status::ok;
  }
  hal::Status receive(hal::CanFrame& frame) override {
    if (answers_.empty()) return hal::Status::not_ready;
    frame = answers_.front();
    answers_.pop_front();
    return hal::Status::ok;
  }
  hal::CanState state() const override { return hal::CanState::active; }

 private:
  int lost_;
  int& heard_;
  std::deque<hal::CanFrame> answers_;
};

Result<KnownMuscle> asked(int lost) {
  return Commander(std::make_unique<LossyBus>(lost), node).muscle();
}

}  // namespace

TEST_GROUP(Commander){};

TEST(Commander, RepeatsALostRequest) {
  const auto known = asked(1);
  CHECK(known.has_value());
  for (const double value : *known)
    DOUBLES_EQUAL(0.5, value, 0.0);
}

TEST(Commander, ReportsThatNoNodeAnswers) {
  const auto known = asked(2);
  CHECK_FALSE(known.has_value());
  STRCMP_CONTAINS("no answer from node 3", known.error().text().c_str());
}

/// For a person or a step that renews: a single lost frame must not end a command to heat.
TEST(Commander, RepeatsARenewalBeforeTheCommandExpires) {
  for (const Verb verb : {Verb::renew, Verb::power, Verb::position, Verb::disarm}) {
    int heard = 0;
    Commander commander(std::make_unique<LossyCommands>(2, heard), node);
    const auto answer = commander.ask(verb, 0.0);
    CHECK(answer.has_value());
    CHECK(*answer == Refusal::none);
    LONGS_EQUAL(3, heard);
  }
}

/// A command that starts something may have been obeyed although its answer was lost.
TEST(Commander, NeverRepeatsACommandThatStartsSomething) {
  for (const Verb verb : {Verb::identify, Verb::store, Verb::reset}) {
    int heard = 0;
    Commander commander(std::make_unique<LossyCommands>(1, heard), node);
    CHECK_FALSE(commander.ask(verb, 0.0).has_value());
    LONGS_EQUAL(1, heard);
  }
}
