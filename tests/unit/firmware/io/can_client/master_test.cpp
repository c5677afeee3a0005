// Which answers on the bus a master takes as its own.
#include "can_client/master.hpp"

#include <supercoil.h>

#include <CppUTest/TestHarness.h>

#include "support/packed.hpp"
#include "telemetry/opcodes.hpp"

using namespace supercoil;
using can_client::Master;

namespace {

constexpr std::uint8_t node = 3;
constexpr std::uint16_t granted = 0x5678;

std::uint8_t counter_of(const hal::CanFrame& request) {
  return request.data[1] & 0x0FU;
}

float value_of(const hal::CanFrame& request) {
  supercoil_command_t m{};
  supercoil_command_unpack(&m, request.data.data(), request.length);
  return m.value;
}

/// The node's answer to a frame that carried this session.
hal::CanFrame answer(const hal::CanFrame& request, std::uint8_t opcode, std::uint16_t session,
                     Refusal refusal, std::uint16_t granted_session = granted) {
  supercoil_acknowledge_t m{};
  m.counter = counter_of(request);
  m.opcode = opcode;
  m.session = session;
  m.refusal = static_cast<std::uint8_t>(refusal);
  m.granted = granted_session;
  return test::sealed(SUPERCOIL_ACKNOWLEDGE_FRAME_ID, SUPERCOIL_ACKNOWLEDGE_LENGTH, node, m,
                      supercoil_acknowledge_pack);
}

hal::CanFrame setting_answer(std::uint8_t counter, std::uint16_t session, Refusal refusal) {
  supercoil_setting_t m{};
  m.counter = counter;
  m.session_low = static_cast<std::uint8_t>(session);
  m.refusal = static_cast<std::uint8_t>(refusal);
  m.setting = 1;
  m.value = 4.5F;
  return test::sealed(SUPERCOIL_SETTING_FRAME_ID, SUPERCOIL_SETTING_LENGTH, node, m,
                      supercoil_setting_pack);
}

}  // namespace

TEST_GROUP(MasterAnswers) {
  static constexpr std::uint16_t nonce = 0x9ABC;
  Master master{node, 0x1234};

  static void claim(Master & who, Refusal refusal, std::uint16_t granted_session) {
    const auto answered = who.receive_acknowledge(
        answer(who.claim(), telemetry::lease, 0x1234, refusal, granted_session));
    CHECK(answered && answered->refusal == refusal);
  }
  void setup() override {
    claim(master, Refusal::claim_again, nonce);
    CHECK_FALSE(master.holds_lease());
    claim(master, Refusal::none, granted);
    CHECK_TRUE(master.holds_lease());
  }
};

TEST(MasterAnswers, ClaimIsGrantedOnlyByTheAnswerToItsOwnName) {
  Master other{node, 0x4321};
  const auto claim = other.claim();
  CHECK_FALSE(other.receive_acknowledge(answer(claim, telemetry::lease, 0x1234, Refusal::none))
                  .has_value());
  CHECK_FALSE(other.holds_lease());
}

TEST(MasterAnswers, ASecondClaimRepeatsTheNonceAndAHoldersClaimHasNone) {
  Master other{node, 0x1234};
  DOUBLES_EQUAL(0.0, value_of(other.claim()), 0.0);
  claim(other, Refusal::claim_again, nonce);
  DOUBLES_EQUAL(nonce, value_of(other.claim()), 0.0);
  DOUBLES_EQUAL(0.0, value_of(master.claim()), 0.0);
}

TEST(MasterAnswers, ReleasingALeaseEndsIt) {
  const auto request = master.release();
  DOUBLES_EQUAL(-1.0, value_of(request), 0.0);
  CHECK(master.receive_acknowledge(answer(request, telemetry::lease, granted, Refusal::none, 0))
            .has_value());
  CHECK_FALSE(master.holds_lease());
}

TEST(MasterAnswers, LeaseEndsWhenTheNodeReportsItLost) {
  for (const auto refusal : {Refusal::no_lease, Refusal::not_lease_holder}) {
    Master holder = master;
    const auto request = holder.command(Verb::rest, 0.0);
    const auto verb = static_cast<std::uint8_t>(Verb::rest);
    CHECK(holder.receive_acknowledge(answer(request, verb, granted, refusal)).has_value());
    CHECK_FALSE(holder.holds_lease());
  }
}

TEST(MasterAnswers, LeaseOutlivesUnrelatedRefusals) {
  const auto request = master.command(Verb::position, 1.0);
  const auto answered = master.receive_acknowledge(
      answer(request, static_cast<std::uint8_t>(Verb::position), granted, Refusal::out_of_range));
  CHECK(answered && answered->refusal == Refusal::out_of_range);
  CHECK_TRUE(master.holds_lease());
}

TEST(MasterAnswers, LeaseEndsOnTheAnswerToItsOwnWrite) {
  const auto request = master.setting_write(1, 4.0);
  const auto answered = master.receive_setting(
      setting_answer(counter_of(request), granted, Refusal::not_lease_holder), true);
  CHECK(answered && answered->refusal == Refusal::not_lease_holder);
  CHECK_FALSE(master.holds_lease());
}

TEST(MasterAnswers, AnotherMastersWriteDoesNotEndTheLease) {
  const auto request = master.setting_write(1, 4.0);
  const auto theirs = setting_answer(counter_of(request), granted + 1, Refusal::not_lease_holder);
  CHECK_FALSE(master.receive_setting(theirs, true).has_value());
  // A client that only reads takes it as the setting's value, whoever holds the lease.
  CHECK(master.receive_setting(theirs, false).has_value());
  CHECK_TRUE(master.holds_lease());
}

TEST(MasterAnswers, DamagedAnswersAreIgnored) {
  const auto request = master.command(Verb::rest, 0.0);
  auto damaged = answer(request, static_cast<std::uint8_t>(Verb::rest), granted, Refusal::no_lease);
  damaged.data[2] ^= 0x10U;
  CHECK_FALSE(master.receive_acknowledge(damaged).has_value());
  CHECK_TRUE(master.holds_lease());
}
