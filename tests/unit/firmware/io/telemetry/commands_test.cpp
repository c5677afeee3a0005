// Leases, sessions and damaged frames.
#include <bit>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include <CppUTest/TestHarness.h>

#include "telemetry/can_endpoint.hpp"
#include "unit/firmware/io/telemetry/support/master.hpp"

using namespace supercoil;
using namespace supercoil::telemetry;
using namespace supercoil::test;
using namespace std::chrono_literals;

TEST_GROUP(CanCommands) {
  CanSettings settings;
  Leases leases{settings.lease_s, 2, std::mt19937(3)};
  Commands commands{settings, leases};
  hal::Time now = 100s;
  Master master;

  Commands::Taken take(const hal::CanFrame& frame) {
    return commands.take(frame, now);
  }
  Refusal refusal_of(const hal::CanFrame& frame) {
    const auto taken = take(frame);
    if (taken.command) return Refusal::none;
    CHECK(taken.answer.has_value());
    return static_cast<Refusal>(read_answer(*taken.answer).refusal);
  }
  /// The granted session; 0: none was granted.
  std::uint16_t claim(Master & who) {
    who.session = who.name;
    const std::uint16_t nonce = nonce_for(who);
    who.session =
        nonce == 0 ? nonce : read_answer(*take(who.frame(Opcode::lease, nonce)).answer).granted;
    return who.session;
  }
  /// The nonce that a first claim is answered with; 0: the claim is refused.
  std::uint16_t nonce_for(Master & who) {
    const auto answer = read_answer(*take(who.frame(Opcode::lease)).answer);
    LONGS_EQUAL(answer.granted == 0 ? 8 : 12, answer.refusal);
    return answer.granted;
  }
};

TEST(CanCommands, AreReceivedForEachChannelWithTheSyncOfAllBoards) {
  settings.first_node = 3;
  const auto ids = telemetry::received_ids(settings, 2);
  const std::set<std::uint16_t> received(ids.begin(), ids.end());
  for (const can::Node node : {can::Node{2}, can::Node{3}, can::Node{4}, can::Node{5}}) {
    const bool is_own = node == 3 || node == 4;
    for (const can::MessageInfo& message :
         {can::message::command, can::message::knot, can::message::play, can::message::status})
      CHECK_EQUAL(is_own, received.contains(can::id_of(message, node)));
  }
  CHECK(received.contains(telemetry::sync_id));
}

TEST(CanCommands, AMasterClaimsALeaseAndIsObeyed) {
  CHECK(claim(master) != 0);
  const auto taken = take(master.frame(Verb::position, 0.012F));
  CHECK(taken.command->verb == Verb::position);
  CHECK(taken.command->source == Source::can);
  DOUBLES_EQUAL(0.012, taken.command->value, 1e-9);
  CHECK_FALSE(taken.answer.has_value());
  const auto answer = read_answer(*commands.answered({*taken.command, Refusal::busy}));
  LONGS_EQUAL(5, answer.refusal);
  LONGS_EQUAL(master.session, answer.session);
  LONGS_EQUAL(4, answer.opcode);
  LONGS_EQUAL(2, answer.counter);
}

TEST(CanCommands, AnswersAreProtectedAsCommandsAre) {
  const auto answer = *take(master.frame(Opcode::lease)).answer;
  LONGS_EQUAL(0x241, answer.id);
  CHECK(can::e2e::intact(answer, SUPERCOIL_ACKNOWLEDGE_LENGTH));
}

TEST(CanCommands, WithoutALeaseAreRefused) {
  CHECK(refusal_of(master.frame(Verb::arm)) == Refusal::no_lease);
}

TEST(CanCommands, OfAnotherMasterAreRefusedLikeItsClaim) {
  claim(master);
  Master other;
  other.name = 0x4321;
  LONGS_EQUAL(0, claim(other));
  other.session = static_cast<std::uint16_t>(master.session + 1);
  CHECK(refusal_of(other.frame(Verb::position, 0.01F)) == Refusal::not_lease_holder);
  CHECK(refusal_of(master.frame(Verb::arm)) == Refusal::none);
}

TEST(CanCommands, StopAndDisarmAreObeyedFromAnyMaster) {
  Master other;
  CHECK(take(other.frame(Verb::disarm)).command->verb == Verb::disarm);
  claim(master);
  other.session = 0xFFFF;
  CHECK(take(other.frame(Verb::disarm)).command->verb == Verb::disarm);
  const auto again = master.frame(Verb::disarm);
  CHECK(take(again).command.has_value());
  const auto repeated = take(again);
  CHECK(repeated.command.has_value());
  CHECK_FALSE(repeated.damaged.has_value());
}

TEST(CanCommands, ALeaseEndsWhenUnusedOrReleased) {
  claim(master);
  const Master gone = master;
  now += 999ms;
  CHECK(refusal_of(master.frame(Verb::renew)) == Refusal::none);
  CHECK(leases.held(0, now));
  now += 1001ms;
  CHECK_FALSE(leases.held(0, now));
  CHECK(refusal_of(master.frame(Verb::renew)) == Refusal::no_lease);
  Master next;
  CHECK(claim(next) != 0);
  // A frame from the earlier session.
  Master earlier = gone;
  CHECK(refusal_of(earlier.frame(Verb::position, 0.01F)) == Refusal::not_lease_holder);
  CHECK(refusal_of(next.frame(Opcode::lease, release_value)) == Refusal::none);
  CHECK_FALSE(leases.held(0, now));
}

TEST(CanCommands, AHolderRenewsALeaseByClaimingItAgain) {
  const std::uint16_t session = claim(master);
  for (int i = 0; i < 30; ++i) {
    now += 900ms;
    LONGS_EQUAL(session, read_answer(*take(master.frame(Opcode::lease)).answer).granted);
  }
  CHECK(refusal_of(master.frame(Verb::arm)) == Refusal::none);
}

TEST(CanCommands, ARefusedMasterDoesNotKeepTheLeaseAlive) {
  claim(master);
  Master other;
  other.session = 77;
  for (int i = 0; i < 11; ++i) {
    now += 100ms;
    refusal_of(other.frame(Verb::arm));
  }
  CHECK(claim(other) != 0);
}

TEST(CanCommands, FramesOfEveryEarlierSessionAreRefused) {
  std::vector<hal::CanFrame> earlier;
  std::set<std::uint16_t> sessions;
  for (int i = 0; i < 100; ++i) {
    Master each;
    CHECK(claim(each) != 0);
    for (const hal::CanFrame& frame : earlier)
      CHECK(refusal_of(frame) == Refusal::not_lease_holder);
    sessions.insert(each.session);
    earlier.push_back(each.frame(Verb::position, 0.01F));
    refusal_of(each.frame(Opcode::lease, release_value));
  }
  CHECK(sessions.size() > 95);
}

TEST(CanCommands, TheNextNonceAndSessionDifferForAnyRandomNumbers) {
  // 0 means nobody; only the low 16 bits count.
  const std::vector<std::uint32_t> numbers{0, 7, 0x10000, 9, 7, 0x20007, 8, 9, 0, 10};
  std::size_t taken = 0;
  Leases twice{settings.lease_s, 1, [&] { return numbers.at(taken++); }};
  for (const auto& [nonce, session] : {std::pair{7, 9}, std::pair{8, 10}}) {
    CHECK(twice.claim(0, 1, 0.0, 0, now) == Refusal::claim_again);
    LONGS_EQUAL(nonce, twice.nonce(0));
    CHECK(twice.claim(0, 1, nonce, 1, now) == Refusal::none);
    LONGS_EQUAL(session, twice.session(0));
    twice.release(0);
  }
  LONGS_EQUAL(numbers.size(), taken);
}

TEST(CanCommands, AreRefusedAtOnceWhenTheQueueIsFull) {
  claim(master);
  for (int i = 0; i < 256; ++i)
    CHECK(take(master.frame(Verb::renew)).command.has_value());
  const auto taken = take(master.frame(Verb::renew));
  CHECK_FALSE(taken.command.has_value());
  CHECK(static_cast<Refusal>(read_answer(*taken.answer).refusal) == Refusal::queue_full);
}

TEST(CanCommands, ALostAnswerDoesNotShiftOthers) {
  claim(master);
  const auto lost = take(master.frame(Verb::arm));
  const auto kept = take(master.frame(Verb::rest));
  const auto answer = read_answer(*commands.answered({*kept.command, Refusal::wrong_state}));
  LONGS_EQUAL(static_cast<int>(Verb::rest), answer.opcode);
  CHECK_FALSE(commands.answered({*lost.command, Refusal::none}).has_value());
}

TEST(CanCommands, AClaimWithALostAnswerIsGrantedAgainOnlyToTheSameMaster) {
  claim(master);
  CHECK(claim(master) != 0);
  Master other;
  other.session = 0x4321;
  const auto taken = take(other.frame(Opcode::lease));
  LONGS_EQUAL(8, read_answer(*taken.answer).refusal);
  LONGS_EQUAL(0, read_answer(*taken.answer).granted);
  refusal_of(master.frame(Verb::arm));
  LONGS_EQUAL(0, claim(other));
}

TEST(CanCommands, ANonceIsValidForOneClaimAndTheDurationOfALease) {
  master.session = master.name;
  const std::uint16_t nonce = nonce_for(master);
  now += 1001ms;
  const auto late = read_answer(*take(master.frame(Opcode::lease, nonce)).answer);
  LONGS_EQUAL(12, late.refusal);
  CHECK(late.granted != nonce);
  const auto taking = master.frame(Opcode::lease, late.granted);
  LONGS_EQUAL(0, read_answer(*take(taking).answer).refusal);
  // The same frame once more, immediately and after the lease has expired.
  LONGS_EQUAL(12, read_answer(*take(taking).answer).refusal);
  now += 1001ms;
  LONGS_EQUAL(12, read_answer(*take(taking).answer).refusal);
  CHECK_FALSE(leases.held(0, now));
}

TEST(CanCommands, OfTwoClaimsTheFirstToRepeatTheNonceIsGranted) {
  Master other;
  other.name = other.session = 0x4321;
  master.session = master.name;
  const std::uint16_t nonce = nonce_for(master);
  LONGS_EQUAL(nonce, nonce_for(other));
  LONGS_EQUAL(0, read_answer(*take(other.frame(Opcode::lease, nonce)).answer).refusal);
  LONGS_EQUAL(8, read_answer(*take(master.frame(Opcode::lease, nonce)).answer).refusal);
}

/// As docs/can.md says about recordings: during its lease a full circle of a session's frames is
/// accepted.
TEST(CanCommands, ReplayOfSixteenRecordedFramesIsObeyedOnlyWithinTheLease) {
  claim(master);
  std::vector<hal::CanFrame> circle;
  for (int i = 0; i < 16; ++i) {
    circle.push_back(master.frame(Verb::renew));
    CHECK(refusal_of(circle.back()) == Refusal::none);
  }
  for (int i = 0; i < 160; ++i) {
    now += 50ms;
    CHECK(refusal_of(circle.at(static_cast<std::size_t>(i) % 16)) == Refusal::none);
  }
  // Single frames are accepted when they are 12 to 15 commands old.
  for (std::size_t age = 0; age < 16; ++age) {
    claim(master);
    now += 2s;
    claim(master);
    std::vector<hal::CanFrame> frames;
    for (int i = 0; i < 16; ++i) {
      frames.push_back(master.frame(Verb::renew));
      commands.answered({*take(frames.back()).command, Refusal::none});
    }
    const bool passes = take(frames.at(15 - age)).command.has_value();
    CHECK_EQUAL(age >= 12, passes);
  }
  now += 2s;
  for (const hal::CanFrame& frame : circle)
    CHECK(refusal_of(frame) == Refusal::no_lease);
}

TEST(CanCommands, AClaimOfVersion3IsRefusedAsAWrongVersion) {
  const auto answer = *take(master.frame(Opcode::claim_of_version_3)).answer;
  LONGS_EQUAL(7, answer.length);
  LONGS_EQUAL(13, read_answer(answer).refusal);
  LONGS_EQUAL(0, read_answer(answer).granted);
  CHECK(take(master.frame(Verb::disarm)).command.has_value());
  CHECK_FALSE(leases.held(0, now));
}

TEST(CanCommands, ARepeatedFrameIsRefusedAndCountsAsDamaged) {
  claim(master);
  const auto frame = master.frame(Verb::position, 0.01F);
  CHECK(take(frame).command.has_value());
  const auto repeated = take(frame);
  CHECK_FALSE(repeated.command.has_value());
  LONGS_EQUAL(0, *repeated.damaged);
  LONGS_EQUAL(10, read_answer(*repeated.answer).refusal);
}

TEST(CanCommands, AnInvalidClaimCountsInTheSequenceToo) {
  claim(master);
  Master replayed = master;
  CHECK(refusal_of(master.frame(Opcode::lease, 1.0F)) == Refusal::out_of_range);
  CHECK(refusal_of(replayed.frame(Verb::arm)) == Refusal::wrong_counter);
  CHECK(refusal_of(master.frame(Verb::arm)) == Refusal::none);
  Master stranger;
  stranger.session = 7;
  CHECK(refusal_of(stranger.frame(Opcode::lease, 1.0F)) == Refusal::not_lease_holder);
}

TEST(CanCommands, UpToThreeFramesMayBeLost) {
  claim(master);
  for (int lost = 0; lost <= 6; ++lost) {
    for (int i = 0; i < lost; ++i)
      master.frame(Verb::renew);
    const Refusal expected = lost <= 3 ? Refusal::none : Refusal::wrong_counter;
    CHECK(refusal_of(master.frame(Verb::renew)) == expected);
    CHECK(refusal_of(master.frame(Verb::renew)) == Refusal::none);
  }
}

TEST(CanCommands, OfOneChannelDoNotAffectTheOther) {
  claim(master);
  Master second;
  second.node = 2;
  second.session = master.session;
  CHECK(refusal_of(second.frame(Verb::arm)) == Refusal::no_lease);
  CHECK(claim(second) != 0);
  LONGS_EQUAL(1, take(second.frame(Verb::arm)).command->channel);
  Master third;
  third.node = 3;
  const auto taken = take(third.frame(Verb::arm));
  CHECK(!taken.command && !taken.answer && !taken.damaged);
}

TEST(CanCommands, ForOneNodeAreDamagedAtAnother) {
  claim(master);
  auto frame = master.frame(Verb::disarm);
  frame.id = 0x202;
  LONGS_EQUAL(1, *take(frame).damaged);
}

TEST(CanCommands, EveryDamageOfUpToThreeBitsIsDetected) {
  claim(master);
  const hal::CanFrame good = master.frame(Verb::disarm);
  long damages = 0;
  const auto is_refused = [&](std::uint64_t bits) {
    hal::CanFrame bad = good;
    for (std::size_t i = 0; i < 8; ++i)
      bad.data[i] ^= static_cast<std::uint8_t>(bits >> (8 * i));
    const auto taken = take(bad);
    ++damages;
    return !taken.command && !taken.answer && taken.damaged == 0;
  };
  for (int a = 0; a < 64; ++a) {
    for (int b = a; b < 64; ++b) {
      for (int c = b; c < 64; ++c) {
        // a = b = c is one bit, a = b or b = c two, and all different three.
        if (a == b && b != c) continue;
        CHECK(is_refused(1ULL << a | 1ULL << b | 1ULL << c));
      }
    }
  }
  LONGS_EQUAL(64 + 64 * 63 / 2 + 64 * 63 * 62 / 6, damages);
  CHECK(take(good).command.has_value());
}

TEST(CanCommands, NoneOfAMillionRandomFramesIsObeyed) {
  claim(master);
  std::mt19937 random(20261120);
  long obeyed = 0;
  long granted = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    hal::CanFrame frame;
    frame.id = 0x201;
    frame.length = 8;
    for (std::uint8_t& byte : frame.data)
      byte = static_cast<std::uint8_t>(random());
    const auto taken = take(frame);
    obeyed += taken.command ? 1 : 0;
    granted += taken.answer && read_answer(*taken.answer).refusal == 0 ? 1 : 0;
  }
  LONGS_EQUAL(0, obeyed);
  LONGS_EQUAL(0, granted);
  CHECK(refusal_of(master.frame(Verb::arm)) == Refusal::none);
}

TEST(CanCommands, AWrongLengthCountsAsDamage) {
  hal::CanFrame frame = master.frame(Verb::disarm);
  for (const int length : {0, 1, 2, 7}) {
    frame.length = static_cast<std::uint8_t>(length);
    LONGS_EQUAL(0, *take(frame).damaged);
  }
}

TEST(CanCommands, TheChecksumIsThatOfTheProfile) {
  // As the package autosar-e2e 1.0.0 (PyPI) computes it for Profile 2.
  master.counter = 5;
  master.session = 0xBEEF;
  LONGS_EQUAL(0xE7, master.frame(Verb::position, 0.012F).data[0]);
}

TEST(CanCommands, NoNonceIsValidBeforeOneIsIssued) {
  // Not even in the first second of the board's clock.
  Leases fresh{settings.lease_s, 1, [] { return 0x1234U; }};
  CHECK(fresh.claim(0, 1, 1.0, 0, hal::Time(0)) == Refusal::claim_again);
  LONGS_EQUAL(0x1234, fresh.nonce(0));
  LONGS_EQUAL(0, fresh.session(0));
}
