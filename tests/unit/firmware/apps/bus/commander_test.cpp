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
    const can::Reader<can::message::muscle_read> request(frame);
    answers_.push_back(can::Encoder<can::message::muscle>(node)
                           .set("quantity", request.get<std::uint8_t>("quantity"))
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
  /// received counts the commands, lost ones included, but not claims.
  LossyCommands(int lost, int& received) : lost_(lost), received_(received) {}

  hal::Status send(const hal::CanFrame& frame) override {
    const can::Reader<can::message::command> request(frame);
    const bool claims = request.get<std::uint8_t>("opcode") == telemetry::lease;
    if (!claims && ++received_ <= lost_) return hal::Status::ok;
    answers_.push_back(can::Encoder<can::message::acknowledge>(node)
                           .set("counter", request.get("counter"))
                           .set("opcode", request.get("opcode"))
                           .set("session", request.get("session"))
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
  int& received_;
  std::deque<hal::CanFrame> answers_;
};

Result<KnownMuscle> muscle_after(int lost) {
  return Commander(std::make_unique<LossyBus>(lost), node).muscle();
}

}  // namespace

TEST_GROUP(Commander){};

TEST(Commander, RepeatsALostRequest) {
  const auto known = muscle_after(1);
  CHECK(known.has_value());
  for (const double value : *known)
    DOUBLES_EQUAL(0.5, value, 0.0);
}

TEST(Commander, ReportsThatNoNodeAnswers) {
  const auto known = muscle_after(2);
  CHECK_FALSE(known.has_value());
  STRCMP_CONTAINS("no answer from node 3", known.error().text().c_str());
}

/// For a person or a step that renews: a single lost frame must not end a command to heat.
TEST(Commander, RepeatsARenewalBeforeTheCommandExpires) {
  for (const Verb verb : {Verb::renew, Verb::power, Verb::position, Verb::disarm}) {
    int received = 0;
    Commander commander(std::make_unique<LossyCommands>(2, received), node);
    const auto answer = commander.ask(verb, 0.0);
    CHECK(answer.has_value());
    CHECK(*answer == Refusal::none);
    LONGS_EQUAL(3, received);
  }
}

/// A command that starts something may have been obeyed although its answer was lost.
TEST(Commander, NeverRepeatsACommandThatStartsSomething) {
  for (const Verb verb : {Verb::identify, Verb::store, Verb::reset}) {
    int received = 0;
    Commander commander(std::make_unique<LossyCommands>(1, received), node);
    CHECK_FALSE(commander.ask(verb, 0.0).has_value());
    LONGS_EQUAL(1, received);
  }
}
