// Controllers and estimators are tuned while the board runs: over CAN, without a jump, and kept.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"

#include "loop/support/can_rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr std::uint8_t pi_place = 0;
constexpr std::uint8_t mrac_place = 2;
constexpr auto estimator_place = static_cast<std::uint8_t>(first_estimator_place);

std::uint8_t tunable(const char* name) {
  return static_cast<std::uint8_t>(control::tunable_named(name));
}

hal::CanFrame write_frame(Master& master, std::uint8_t place, std::uint8_t which, float value) {
  supercoil_tuning_write_t m{};
  m.counter = master.next_counter();
  m.place = place;
  m.tunable = which;
  m.session_low = static_cast<std::uint8_t>(master.session & 0xFFU);
  m.value = value;
  return sealed(SUPERCOIL_TUNING_WRITE_FRAME_ID, SUPERCOIL_TUNING_WRITE_LENGTH, master.node, m,
                supercoil_tuning_write_pack);
}

hal::CanFrame read_frame(std::uint8_t place, std::uint8_t which, TuningSet set) {
  const auto first = static_cast<std::uint8_t>(place | static_cast<unsigned>(set) << 4U);
  return {SUPERCOIL_TUNING_READ_FRAME_ID, SUPERCOIL_TUNING_READ_LENGTH, {first, which}, {}};
}

struct TuningRig : CanRig {
  using CanRig::CanRig;
  /// All zero: no answer.
  supercoil_tuning_t request(const hal::CanFrame& frame) {
    last_of.erase(SUPERCOIL_TUNING_FRAME_ID);
    bus.deliver(frame);
    for (int i = 0; i < 20 && !last_of.contains(SUPERCOIL_TUNING_FRAME_ID); ++i)
      tick();
    supercoil_tuning_t received{};
    const hal::CanFrame& answer = last_of[SUPERCOIL_TUNING_FRAME_ID];
    supercoil_tuning_unpack(&received, answer.data.data(), answer.length);
    return received;
  }
  Refusal write(Master& master, std::uint8_t place, const char* name, float value) {
    return static_cast<Refusal>(request(write_frame(master, place, tunable(name), value)).refusal);
  }
  double read(std::uint8_t place, const char* name, TuningSet set) {
    return static_cast<double>(request(read_frame(place, tunable(name), set)).value);
  }
  Refusal tune(Master& master, std::uint8_t place) {
    const auto sent = telemetry::encode_command(Verb::tune, place);
    return command(master, sent.opcode, static_cast<float>(sent.value));
  }
  board::Learned stored() {
    board::LearnedUpdate update;
    CHECK(loop.channel(0).take_learned_update(update));
    CHECK(update.has_value());
    return update.value_or(board::Learned{});
  }
};

}  // namespace

TEST_GROUP(TuningOverCan) {
  TuningRig rig;
  Master master;

  void follow(double time_s) {
    for (long i = std::lround(time_s / 0.05); i > 0; --i) {
      CHECK(rig.command(master, Verb::renew) == Refusal::none);
      rig.run(0.048);
    }
  }
};

TEST(TuningOverCan, PreparedValuesAreUsedAfterTune) {
  rig.run(1.0);
  rig.claim(master);
  const auto value = [&](TuningSet set) { return rig.read(pi_place, "proportional_W_per_m", set); };
  const double configured = value(TuningSet::configured);
  const auto wanted = static_cast<float>(0.5 * configured);
  CHECK(rig.write(master, pi_place, "proportional_W_per_m", wanted) == Refusal::none);
  DOUBLES_EQUAL(wanted, value(TuningSet::prepared), 0.0);
  DOUBLES_EQUAL(configured, value(TuningSet::in_use), 0.0);
  CHECK(rig.tune(master, pi_place) == Refusal::none);
  DOUBLES_EQUAL(wanted, value(TuningSet::in_use), 0.0);
  DOUBLES_EQUAL(configured, value(TuningSet::configured), 0.0);
  // The way back.
  const auto back = static_cast<float>(TuningSet::configured);
  LONGS_EQUAL(0, rig.request(write_frame(master, pi_place, telemetry::all_tunables, back)).refusal);
  CHECK(rig.tune(master, pi_place) == Refusal::none);
  DOUBLES_EQUAL(configured, value(TuningSet::in_use), 0.0);
}

TEST(TuningOverCan, ARunningControllerChangesItsGainsWithoutAJump) {
  rig.start(master);
  rig.command(master, Verb::controller, pi_place);
  follow(30.0);
  const double before_m = rig.loop.channel(0).snapshot().position_m;
  const double before_W = rig.loop.channel(0).snapshot().demanded_W;
  CHECK(rig.write(master, pi_place, "proportional_W_per_m", 500.0F) == Refusal::none);
  CHECK(rig.write(master, pi_place, "integral_W_per_m_s", 300.0F) == Refusal::none);
  CHECK(rig.tune(master, pi_place) == Refusal::none);
  double furthest_W = 0.0;
  for (int i = 0; i < 40; ++i) {
    rig.tick();
    const double now_W = rig.loop.channel(0).snapshot().demanded_W;
    furthest_W = std::fmax(furthest_W, std::abs(now_W - before_W));
  }
  // 10 um of noise times the gain before: 2000 W/m.
  CHECK(furthest_W < 0.15);
  follow(2.0);
  DOUBLES_EQUAL(before_m, rig.loop.channel(0).snapshot().position_m, 2e-4);
  CHECK(rig.state() == State::active);
}

TEST(TuningOverCan, TheControlLawCanBeReplaced) {
  rig.start(master);
  CHECK(rig.write(master, pi_place, "kind", 5.0F) == Refusal::none);
  CHECK(rig.write(master, pi_place, "bandwidth_rad_per_s", 6.1F) == Refusal::none);
  CHECK(rig.tune(master, pi_place) == Refusal::none);
  // The decimal number that was meant, not the float's value.
  DOUBLES_EQUAL(6.1,
                rig.loop.channel(0).tuner().value(TuningSet::in_use, pi_place,
                                                  tunable("bandwidth_rad_per_s")),
                0.0);
  CHECK(std::isnan(rig.read(pi_place, "integral_W_per_m_s", TuningSet::in_use)));
  follow(20.0);
  DOUBLES_EQUAL(0.012, rig.loop.channel(0).snapshot().position_m, 5e-4);
}

TEST(TuningOverCan, UnusableValuesAreRefusedAndChangeNothing) {
  rig.run(1.0);
  rig.claim(master);
  CHECK(rig.write(master, pi_place, "proportional_W_per_m", -1.0F) == Refusal::out_of_range);
  CHECK(rig.write(master, pi_place, "bandwidth_rad_per_s", 5.0F) == Refusal::out_of_range);
  CHECK(rig.write(master, 9, "kind", 1.0F) == Refusal::out_of_range);
  CHECK(rig.write(master, pi_place, "learn", NAN) == Refusal::out_of_range);
  // In range, and unstable on this muscle.
  CHECK(rig.write(master, pi_place, "integral_W_per_m_s", 1e7F) == Refusal::none);
  CHECK(rig.tune(master, pi_place) == Refusal::unsuitable);
  STRCMP_CONTAINS("unstable", rig.loop.channel(0).tuner().problem().c_str());
  // MRAC's proof requires a model with certain poles.
  CHECK(rig.write(master, mrac_place, "reference_model", 1.0F) == Refusal::none);
  CHECK(rig.tune(master, mrac_place) == Refusal::unsuitable);
  CHECK(rig.tune(master, 3) == Refusal::out_of_range);
  for (const float place : {1000.0F + 1e30F, INFINITY, NAN})
    CHECK(rig.command(master, Verb::controller, place) == Refusal::out_of_range);
  // The configured model of pi has no real poles.
  CHECK(rig.write(master, pi_place, "model_pole_1_rad_per_s", 3.0F) == Refusal::out_of_range);
  CHECK(rig.write(master, pi_place, "reference_model", 0.0F) == Refusal::none);
  CHECK(rig.write(master, pi_place, "model_pole_1_rad_per_s", 3.0F) == Refusal::none);
  const double configured = rig.read(pi_place, "integral_W_per_m_s", TuningSet::configured);
  DOUBLES_EQUAL(configured, rig.read(pi_place, "integral_W_per_m_s", TuningSet::in_use), 0.0);
}

TEST(TuningOverCan, WritingNeedsTheLeaseAndReadingDoesNot) {
  rig.run(1.0);
  CHECK(rig.write(master, pi_place, "kind", 1.0F) == Refusal::no_lease);
  rig.claim(master);
  Master other = master;
  other.session = static_cast<std::uint16_t>(master.session ^ 1U);
  CHECK(rig.write(other, pi_place, "kind", 2.0F) == Refusal::not_lease_holder);
  DOUBLES_EQUAL(1.0, rig.read(pi_place, "kind", TuningSet::prepared), 0.0);
  // Damage counts, and is not answered.
  hal::CanFrame damaged = write_frame(master, pi_place, tunable("kind"), 2.0F);
  damaged.data[7] ^= 1U;
  LONGS_EQUAL(0, rig.request(damaged).crc);
  DOUBLES_EQUAL(1.0, rig.read(pi_place, "kind", TuningSet::prepared), 0.0);
}

TEST(TuningOverCan, StoredValuesAreUsedAtTheNextStart) {
  rig.run(1.0);
  rig.claim(master);
  CHECK(rig.write(master, pi_place, "integral_W_per_m_s", 700.0F) == Refusal::none);
  CHECK(rig.tune(master, pi_place) == Refusal::none);
  CHECK(rig.command(master, Verb::controller, mrac_place) == Refusal::none);
  CHECK(rig.command(master, Verb::store, static_cast<float>(store_tuning)) == Refusal::none);
  DOUBLES_EQUAL(700.0, rig.read(pi_place, "integral_W_per_m_s", TuningSet::stored), 0.0);
  const board::Learned learned = rig.stored();
  CHECK_FALSE(learned.has_muscle);

  RigSettings again = rough_board();
  ChannelSettings& channel = again.firmware.channels[0];
  const double configured = channel.controllers[pi_place].pi.integral_W_per_m_s;
  apply_learned(channel, learned);
  DOUBLES_EQUAL(700.0, channel.controllers[pi_place].pi.integral_W_per_m_s, 0.0);
  TuningRig next(again);
  next.run(0.1);
  LONGS_EQUAL(mrac_place, next.loop.channel(0).snapshot().controller);
  const auto value = [&](TuningSet set) { return next.read(pi_place, "integral_W_per_m_s", set); };
  DOUBLES_EQUAL(700.0, value(TuningSet::in_use), 0.0);
  DOUBLES_EQUAL(700.0, value(TuningSet::stored), 0.0);
  DOUBLES_EQUAL(configured, value(TuningSet::configured), 0.0);
  // Once forgotten, it stays in use until the next start.
  next.claim(master);
  CHECK(next.command(master, Verb::store, static_cast<float>(clear_tuning)) == Refusal::none);
  DOUBLES_EQUAL(configured, value(TuningSet::stored), 0.0);
  DOUBLES_EQUAL(700.0, value(TuningSet::in_use), 0.0);
  CHECK(next.stored().tuning == board::StoredTuning{});
}

TEST(TuningOverCan, AnEstimatorRestartsWithItsNewValues) {
  rig.start(master);
  follow(30.0);
  const auto theta = [&] { return rig.loop.channel(0).snapshot().theta; };
  const control::Theta learned = theta();
  CHECK(rig.write(master, estimator_place, "trusted_error", 0.05F) == Refusal::none);
  CHECK(rig.write(master, estimator_place, "proportional_W_per_m", 1.0F) == Refusal::out_of_range);
  CHECK(rig.write(master, estimator_place + 1, "trusted_error", 0.05F) == Refusal::out_of_range);
  CHECK(rig.tune(master, estimator_place + 1) == Refusal::out_of_range);
  CHECK(theta() != learned);  // it goes on learning
  CHECK(rig.tune(master, estimator_place) == Refusal::none);
  const control::PhysicalParameters known = rough_board().firmware.channels[0].muscle;
  const control::Theta begins = control::theta_from(known);
  for (int i = 0; i < 4; ++i)
    DOUBLES_EQUAL(1.0, theta()[i] / begins[i], 0.05);
  CHECK((learned - begins).cwiseQuotient(begins).cwiseAbs().maxCoeff() > 0.05);
  // Meanwhile the muscle still follows.
  follow(5.0);
  DOUBLES_EQUAL(0.012, rig.loop.channel(0).snapshot().position_m, 5e-4);

  CHECK(rig.command(master, Verb::store, static_cast<float>(store_tuning)) == Refusal::none);
  const board::Learned learned_set = rig.stored();
  ChannelSettings channel = rough_board().firmware.channels[0];
  apply_learned(channel, learned_set);
  DOUBLES_EQUAL(0.05, channel.estimators[0].excitation.trusted_error, 0.0);
  LONGS_EQUAL(1, channel.configured_estimators.size());
}

TEST(TuningOverCan, AnEstimatorCanBeReplaced) {
  rig.run(1.0);
  rig.claim(master);
  CHECK(rig.write(master, estimator_place, "kind", 2.0F) == Refusal::none);
  CHECK(rig.write(master, estimator_place, "forgetting_s", 12.5F) == Refusal::none);
  CHECK(rig.tune(master, estimator_place) == Refusal::none);
  DOUBLES_EQUAL(12.5, rig.read(estimator_place, "forgetting_s", TuningSet::in_use), 0.0);
  CHECK(std::isnan(rig.read(estimator_place, "window_s", TuningSet::in_use)));
  DOUBLES_EQUAL(1.0, rig.read(estimator_place, "kind", TuningSet::configured), 0.0);
}
