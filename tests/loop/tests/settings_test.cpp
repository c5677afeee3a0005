// What may be changed on a running board over CAN.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "loop/support/can_rig.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr std::uint8_t max_power = 0;
constexpr auto rate_of(telemetry::Message message) {
  return static_cast<std::uint8_t>(1 + static_cast<int>(message));
}
constexpr std::uint8_t position_rate = rate_of(telemetry::Message::measurement);

hal::CanFrame read_frame(std::uint8_t setting) {
  hal::CanFrame frame;
  frame.id = SUPERCOIL_SETTING_READ_FRAME_ID;
  frame.length = SUPERCOIL_SETTING_READ_LENGTH;
  frame.data[0] = setting;
  return frame;
}

Refusal refusal_in(const supercoil_setting_t& answer) {
  return static_cast<Refusal>(answer.refusal);
}

}  // namespace

/// The estimator begins at the muscle's values, so it only has to confirm them. An earlier identify
/// has said how well it had found them.
RigSettings well_known() {
  RigSettings settings = rough_board();
  ChannelSettings& channel = settings.firmware.channels[0];
  channel.unexplained_ratio = 0.03;
  channel.identification = {{0.1, 0.1, 0.1, 0.1}, 1795219200.0};
  control::GradientSettings& gradient = channel.estimators[0].gradient;
  gradient.initial = gradient.scale.nominal;
  return settings;
}

TEST_GROUP(Settings) {
  CanRig rig{well_known()};
  Master master;

  Refusal write(std::uint8_t setting, float value) {
    return refusal_in(rig.request_setting(master.setting(setting, value)));
  }
  double read(std::uint8_t setting) {
    return static_cast<double>(rig.request_setting(read_frame(setting)).value);
  }
};

TEST(Settings, AreReadableWithoutALease) {
  rig.run(0.1);
  DOUBLES_EQUAL(rig.settings.firmware.channels[0].limiter.max_W, read(max_power), 1e-6);
  DOUBLES_EQUAL(100.0, read(position_rate), 0.0);
  for (std::uint8_t i = 0; i < telemetry::run_settings; ++i) {
    const auto answer = rig.request_setting(read_frame(i));
    LONGS_EQUAL(i, answer.setting);
    CHECK(refusal_in(answer) == Refusal::none);
  }
  CHECK(refusal_in(rig.request_setting(read_frame(telemetry::run_settings))) ==
        Refusal::out_of_range);
}

TEST(Settings, AreWritableOnlyUnderTheLease) {
  rig.run(0.1);
  CHECK(write(max_power, 1.0F) == Refusal::no_lease);
  CHECK(rig.claim(master) == Refusal::none);
  Master other;
  other.session = static_cast<std::uint16_t>(master.session + 1);
  CHECK(refusal_in(rig.request_setting(other.setting(max_power, 1.0F))) ==
        Refusal::not_lease_holder);
  DOUBLES_EQUAL(rig.settings.firmware.channels[0].limiter.max_W, read(max_power), 1e-6);
  const auto answer = rig.request_setting(master.setting(max_power, 1.0F));
  CHECK(refusal_in(answer) == Refusal::none);
  LONGS_EQUAL(master.session & 0xFF, answer.session_low);
  DOUBLES_EQUAL(1.0, read(max_power), 0.0);
}

TEST(Settings, ShareTheCommandCounter) {
  rig.run(0.1);
  rig.claim(master);
  const hal::CanFrame once = master.setting(max_power, 1.0F);
  CHECK(refusal_in(rig.request_setting(once)) == Refusal::none);
  CHECK(refusal_in(rig.request_setting(once)) == Refusal::wrong_counter);
  CHECK(rig.command(master, Verb::disarm) == Refusal::none);
  CHECK(write(max_power, 2.0F) == Refusal::none);
}

TEST(Settings, MaxPowerTakesEffectAtOnceAndCannotExceedTheConfigured) {
  rig.start(master);
  CHECK(rig.command(master, Verb::power, 2.0F) == Refusal::none);
  rig.run(0.1);
  CHECK(rig.true_power_W() > 1.0);
  CHECK(write(max_power, 0.5F) == Refusal::none);
  CHECK(rig.command(master, Verb::renew) == Refusal::none);
  rig.run(0.05);
  CHECK(rig.true_power_W() < 0.55);
  CHECK(rig.loop.channel(0).snapshot().limited_by == LimitedBy::maximum);
  const auto configured_W = static_cast<float>(rig.settings.firmware.channels[0].limiter.max_W);
  for (const float wrong : {-0.1F, 1.001F * configured_W, 1e6F, NAN, INFINITY})
    CHECK(write(max_power, wrong) == Refusal::out_of_range);
  rig.run(0.01);
  LONGS_EQUAL(5, rig.refused_values.size());
  DOUBLES_EQUAL(0.0, rig.refused_values[0].nearest, 0.0);
  DOUBLES_EQUAL(1e6F, rig.refused_values[2].value, 0.0);
  DOUBLES_EQUAL(configured_W, rig.refused_values[2].nearest, 0.0);
  CHECK(std::isnan(rig.refused_values[3].nearest));
  DOUBLES_EQUAL(0.5, read(max_power), 0.0);
  CHECK(write(max_power, configured_W) == Refusal::none);
  DOUBLES_EQUAL(configured_W, read(max_power), 0.0);
}

TEST(Settings, TheConfiguredPowerIsAcceptedDespiteFloatRounding) {
  RigSettings settings = rough_board();
  settings.firmware.channels[0].limiter.max_W = 2.15;
  CanRig small(settings);
  small.run(0.1);
  small.claim(master);
  CHECK(refusal_in(small.request_setting(master.setting(max_power, 2.15F))) == Refusal::none);
  DOUBLES_EQUAL(2.15, small.loop.channel(0).max_power_W(), 0.0);
}

TEST(Settings, AMessageIsSentAtItsWrittenRate) {
  rig.run(0.1);
  rig.claim(master);
  CHECK(write(position_rate, 20.0F) == Refusal::none);
  rig.received_count.clear();
  rig.run(2.0);
  const int received = rig.received_count[SUPERCOIL_MEASUREMENT_FRAME_ID];
  CHECK(received >= 39 && received <= 41);
  rig.claim(master);
  CHECK(write(position_rate, 0.0F) == Refusal::none);
  rig.received_count.clear();
  rig.run(1.0);
  LONGS_EQUAL(0, rig.received_count[SUPERCOIL_MEASUREMENT_FRAME_ID]);
}

TEST(Settings, RatesCannotSilenceTheHeartbeatOrOverloadTheBus) {
  rig.run(0.1);
  rig.claim(master);
  constexpr std::uint8_t heartbeat = rate_of(telemetry::Message::status);
  for (const float wrong : {0.0F, 0.5F, NAN, -1.0F, 1001.0F})
    CHECK(write(heartbeat, wrong) == Refusal::out_of_range);
  for (const float wrong : {1e-30F, NAN, -1.0F, 1001.0F, INFINITY})
    CHECK(write(position_rate, wrong) == Refusal::out_of_range);
  // Each alone fits on the bus, all together do not.
  int refused = 0;
  for (std::uint8_t i = 1; i < telemetry::run_settings; ++i)
    refused += write(i, 700.0F) == Refusal::out_of_range ? 1 : 0;
  CHECK(refused > 5);
  CHECK(telemetry::bus_load(rig.link.publisher().rates_Hz(), rig.can.bit_rate) <= rig.can.max_load);
}

TEST(Settings, SenseGainsAreReadOnly) {
  rig.run(0.1);
  rig.claim(master);
  for (std::uint8_t i = telemetry::supply_gain; i < telemetry::run_settings; ++i) {
    const double before = read(i);
    CHECK(write(i, 10.0F) == Refusal::out_of_range);
    DOUBLES_EQUAL(before, read(i), 0.0);
  }
}

TEST(Settings, DamagedWritesAreIgnoredAndCounted) {
  rig.run(16.0);
  rig.claim(master);
  for (int bit = 0; bit < 64; ++bit) {
    hal::CanFrame frame = master.setting(max_power, 1.0F);
    frame.data[static_cast<std::size_t>(bit / 8)] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    LONGS_EQUAL(0, rig.request_setting(frame).counter);
    CHECK(rig.setting_answers.empty());
  }
  DOUBLES_EQUAL(rig.settings.firmware.channels[0].limiter.max_W, read(max_power), 1e-6);
  CHECK(rig.fault() == Fault::command_damaged);
}

TEST(Settings, LearnedMuscleIsStoredOnlyWhenTrustedAndClearedAnyTime) {
  rig.start(master);
  CHECK(rig.command(master, Verb::store, 1.0F) == Refusal::not_ready);
  CHECK(rig.command(master, Verb::store, 0.5F) == Refusal::out_of_range);
  CHECK(rig.command(master, Verb::store, NAN) == Refusal::out_of_range);
  board::LearnedUpdate update;
  CHECK_FALSE(rig.loop.channel(0).take_learned_update(update));
  CHECK(rig.command(master, Verb::store, 0.0F) == Refusal::none);
  CHECK(rig.loop.channel(0).take_learned_update(update));
  CHECK_FALSE(update.has_value());
  // Moved until its estimates may be trusted.
  Refusal stored = Refusal::not_ready;
  for (int i = 0; i < 4000 && stored == Refusal::not_ready; ++i) {
    const double time_s = 0.05 * i;
    const double power_W = 2.2 + 0.5 * (std::sin(0.3 * time_s) + std::sin(1.1 * time_s)) +
                           0.5 * (std::sin(3.1 * time_s) + std::sin(9.0 * time_s));
    CHECK(rig.command(master, Verb::power, static_cast<float>(power_W)) == Refusal::none);
    rig.run(0.048);
    if (i % 20 == 0) stored = rig.command(master, Verb::store, 1.0F);
  }
  CHECK(stored == Refusal::none);
  CHECK(rig.loop.channel(0).take_learned_update(update));
  DOUBLES_EQUAL(16.0, update->muscle.stiffness_N_per_m, 3.0);
  // What motion cannot show stays as it was believed.
  const control::PhysicalParameters& believed = rig.settings.firmware.channels[0].muscle;
  DOUBLES_EQUAL(believed.force_per_kelvin_N_per_K, update->muscle.force_per_kelvin_N_per_K, 0.0);
  DOUBLES_EQUAL(believed.moving_mass_kg, update->muscle.moving_mass_kg, 0.0);
  // An earlier identify's measures belong to the muscle that it found.
  DOUBLES_EQUAL(0.0, update->unexplained_ratio, 0.0);
  CHECK(update->identification == board::Identification{});
  CHECK_TRUE(std::isnan(rig.loop.channel(0).known(known_unexplained_ratio)));
}
