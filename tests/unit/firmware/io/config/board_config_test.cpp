// Valid configurations: the examples, defaults, and what channels have in common.
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/bus_time.hpp"
#include "config/describe.hpp"
#include "config/recommended_controller.hpp"
#include "loop/feasibility.hpp"
#include "text/number_text.hpp"
#include "unit/firmware/io/config/support/small_board.hpp"

using namespace supercoil;
using namespace supercoil::config;

namespace {

BoardConfig read(const std::string& text) {
  const auto config = parse_board_config(text, "b.toml");
  CHECK_TEXT(config.has_value(), config ? "" : to_text(config.error()).c_str());
  return config.value();
}

BoardConfig example(const std::string& name) {
  const auto config = read_board_config(SUPERCOIL_EXAMPLES "/" + name);
  CHECK_TEXT(config.has_value(), config ? "" : to_text(config.error()).c_str());
  return config.value();
}

void check_says(const std::string& text, const std::string& part) {
  CHECK_TEXT(text.find(part) != std::string::npos, (part + "\nis not in\n" + text).c_str());
}

}  // namespace

TEST_GROUP(BoardConfig){};

TEST(BoardConfig, DescriptionSaysWhatALostMuscleOfABundleCauses) {
  const auto described = [](const std::string& keys, const std::string& heater = "") {
    return describe(read(test::small_board_with(
        "[channel.heater]\n", "[channel.bundle]\n" + keys + "\n[channel.heater]\n" + heater)));
  };
  check_says(
      described("muscles = 3\nwired = 'parallel'"),
      "bundle      3 muscles, their threads in parallel: when one breaks the resistance is 50 "
      "% more, and each of the others gets 1.5 times its share\n");
  check_says(described("muscles = 2"), "series: when one is shorted the resistance is 50 % less");
  CHECK(described("muscles = 3").find("one shorted muscle") == std::string::npos);
  check_says(described("muscles = 5"),
             "channel 1: resistance_drift: one shorted muscle of 5 in series is 20 % less "
             "resistance, which resistance_drift lets pass: the others get 1.25 times their share "
             "undetected");
  // A muscle of three that is hot, but by its bounds may be cold, has as much as all three cold.
  check_says(described("muscles = 3", "temperature_coefficient_per_K = 0.002\n"),
             "one shorted muscle of 3 in series is 33 % less resistance");
}

TEST(BoardConfig, ABundleMayBeSetForEveryChannel) {
  const BoardConfig c =
      read(test::small_board + "[every_channel.bundle]\nmuscles = 3\nwired = 'parallel'\n");
  CHECK(c.labels[0].bundle && c.labels[0].bundle->muscles == 3 && c.labels[0].bundle->parallel());
}

TEST(BoardConfig, JointExampleIsTwoChannelsAtOneSensor) {
  const BoardConfig c = example("joint-as5600-ads1115.toml");
  UNSIGNED_LONGS_EQUAL(2, c.settings.channels.size());
  UNSIGNED_LONGS_EQUAL(1, c.settings.joints.size());
  check_says(describe(c), "from -7.9 mm (-30.1°) to 7.9 mm (30.1°)");
  CHECK(describe(c).find("promises") == std::string::npos);  // only a single muscle has promises
}

TEST(BoardConfig, SlowExampleIsFourChannelsBehindI2c) {
  const BoardConfig c = example("raspberry-pi-pca9685-ads1115.toml");
  STRCMP_EQUAL("four muscles, I2C", c.name.c_str());
  DOUBLES_EQUAL(100.0, c.settings.rate_Hz, 0.0);
  DOUBLES_EQUAL(0.150, c.settings.supervision.charge_pump_decay_s, 1e-12);
  UNSIGNED_LONGS_EQUAL(4, c.settings.channels.size());
  UNSIGNED_LONGS_EQUAL(4, c.wiring.channels.size());
  STRCMP_EQUAL("rear left", c.labels[2].name.c_str());
  STRCMP_EQUAL("GPIO17", c.wiring.heartbeat.line.c_str());
  STRCMP_EQUAL("pinctrl-bcm2711", c.wiring.channels[3].enable.chip.c_str());
  LONGS_EQUAL(3, c.wiring.channels[3].pwm.number);
  LONGS_EQUAL(4095, c.wiring.channels[3].pwm.steps);
  STRCMP_EQUAL("i2c-5/5-004b", c.wiring.channels[3].current.device.c_str());
  CHECK(c.wiring.channels[3].position.access.buffered());
  DOUBLES_EQUAL(0.03, c.settings.channels[0].position.max_age_s, 1e-12);
  DOUBLES_EQUAL(4.5, c.settings.channels[0].limiter.max_W, 0.0);
  DOUBLES_EQUAL(160.0, c.settings.channels[0].limiter.derate_to_C, 0.0);
  DOUBLES_EQUAL(30.0, c.settings.channels[0].thermal.air.warmest_C, 0.0);
  CHECK_FALSE(check(c.settings).has_value());
}

TEST(BoardConfig, SlowExampleFitsItsBuses) {
  const BoardConfig c = example("raspberry-pi-pca9685-ads1115.toml");
  const double reading_s = 47.0 / 400e3 + 20e-6;
  const double duty_s = 5.0 * (29.0 / 400e3 + 20e-6);
  DOUBLES_EQUAL(4.0 * duty_s + reading_s, bus_time(c.wiring, c.wiring.buses[0]).total_s, 1e-12);
  DOUBLES_EQUAL(4.0 * reading_s, bus_time(c.wiring, c.wiring.buses[1]).total_s, 1e-12);
  DOUBLES_EQUAL(0.01, c.settings.channels[0].heater.delay_s, 1e-12);
  const std::string text = describe(c);
  check_says(text, "four muscles, I2C: 4 channels at 100 Hz\n");
  check_says(text, "the charge pump opens the supply within 150 ms");
  check_says(text, "  i2c-1: 1.988 ms, 19.9 %, at 400 kHz\n");
  check_says(text, "  i2c-3: 0.55 ms, 5.5 %, at 400 kHz\n");
  check_says(text,
             "channels 1, 2, 3, 4: sensors_disagree: heater.temperature_coefficient_per_K is 0");
  // The senses were never compared: the supply may be 13.2 V when 10.8 V are read.
  check_says(text, "once identified, the muscle gets no more than 2.27 W (limited_by unproven)");
  check_says(text, "recorder 700 KiB: 16 s of ticks, 112 bytes per channel and tick");
}

TEST(BoardConfig, FastExampleHasAMuscleNearSkin) {
  const BoardConfig c = example("on-chip-pwm-fast-converter.toml");
  DOUBLES_EQUAL(1000.0, c.settings.rate_Hz, 0.0);
  UNSIGNED_LONGS_EQUAL(2, c.settings.channels.size());
  CHECK_FALSE(c.wiring.channels[0].pwm.access.buffered());
  DOUBLES_EQUAL(0.0, c.settings.channels[0].heater.delay_s, 0.0);
  CHECK(c.wiring.supply.capture == (Capture{"supercoil", 64}));
  CHECK(c.wiring.channels[0].position.capture == c.wiring.supply.capture);
  CHECK_FALSE(c.wiring.channels[0].position.access.buffered());
  UNSIGNED_LONGS_EQUAL(2, c.settings.channels[0].controllers.size());
  CHECK(c.settings.channels[0].controllers[0].kind == control::ControllerKind::mrac);
  CHECK(c.settings.channels[0].controllers[1].kind == control::ControllerKind::pi);
  CHECK(c.labels[1].preset == Preset::skin);
  const ChannelSettings& sleeve = c.settings.channels[1];
  DOUBLES_EQUAL(38.0, sleeve.limiter.derate_from_C, 0.0);
  DOUBLES_EQUAL(43.0, sleeve.limiter.derate_to_C, 0.0);
  DOUBLES_EQUAL(43.0, sleeve.supervision.trip_C, 0.0);
  DOUBLES_EQUAL(13.0, sleeve.thermal.boot_rise_K, 1e-9);
  const std::string text = describe(c);
  check_says(text, "voltage0 of ads7951, captured at supercoil");
  check_says(text, "  no bus: every device is direct\n");
  check_says(text, "channel 2: sleeve\n");
  check_says(text, "near skin: full power up to 38 °C, none from 43 °C on");
}

TEST(BoardConfig, DescriptionHasTheTuningStoredByTune) {
  BoardConfig c = read(test::small_board);
  CHECK(describe(c).find("stored by tune") == std::string::npos);
  auto& values = c.settings.channels[0].tuning.controllers[0].values;
  values[control::tunable_named("bandwidth_rad_per_s")] = 6.5;
  values[control::tunable_named("learn")] = 0.0;
  STRCMP_CONTAINS("stored by tune: bandwidth_rad_per_s = 6.5, learn = 0", describe(c).c_str());
}

TEST(BoardConfig, SmallBoardIsCompletedByDefaults) {
  const BoardConfig c = read(test::small_board);
  const ChannelSettings& channel = c.settings.channels.at(0);
  STRCMP_EQUAL("b", c.name.c_str());
  STRCMP_EQUAL("channel 1", c.labels[0].name.c_str());
  STRCMP_EQUAL("/var/lib/supercoil", c.storage_folder.c_str());
  CHECK_FALSE(c.wiring.light.has_value());
  CHECK_FALSE(c.wiring.watchdog.has_value());
  DOUBLES_EQUAL(1000.0, c.settings.rate_Hz, 0.0);
  DOUBLES_EQUAL(0.0005, c.settings.supervision.late_s, 1e-12);
  DOUBLES_EQUAL(0.25, channel.supervision.command_timeout_s, 1e-12);
  DOUBLES_EQUAL(5.0, channel.supervision.min_resistance_Ohm, 1e-12);
  DOUBLES_EQUAL(1.25 * 4.5 + 0.3, channel.supervision.max_measured_W, 1e-12);
  DOUBLES_EQUAL(130.0, channel.thermal.boot_rise_K, 1e-9);
  CHECK(channel.muscle == control::PhysicalParameters{});
  UNSIGNED_LONGS_EQUAL(1, channel.controllers.size());
  UNSIGNED_LONGS_EQUAL(1, channel.estimators.size());
}

TEST(BoardConfig, ChannelOverridesEveryChannel) {
  const BoardConfig c = read(test::small_board +
                             "[every_channel]\nname = 'all'\n"
                             "muscle = {stiffness_N_per_m = 20.0, damping_Ns_per_m = 3.0}\n"
                             "controller = {kind = 'pi', integral_W_per_m_s = 7.0}\n"
                             "[channel.muscle]\nstiffness_N_per_m = 12.0\n");
  const ChannelSettings& channel = c.settings.channels.at(0);
  STRCMP_EQUAL("all", c.labels[0].name.c_str());
  DOUBLES_EQUAL(12.0, channel.muscle.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(3.0, channel.muscle.damping_Ns_per_m, 0.0);
  DOUBLES_EQUAL(7.0, channel.controllers[0].pi.integral_W_per_m_s, 0.0);
}

TEST(BoardConfig, ControllerOfAChannelReplacesTheWholeCommonOne) {
  const BoardConfig c = read(test::small_board +
                             "[every_channel.controller]\nkind = 'pi'\nintegral_W_per_m_s = 7.0\n"
                             "[channel.controller]\nkind = 'pd_ff'\n");
  CHECK(c.settings.channels[0].controllers[0].kind == control::ControllerKind::pd_ff);
}

TEST(BoardConfig, ThresholdsOfASlowBoardLastAtLeastAFewTicks) {
  const BoardConfig c = read(test::small_board_with("charge_pump_decay_ms = 20",
                                                    "charge_pump_decay_ms = 150\nrate_Hz = 100"));
  const ChannelSupervision& s = c.settings.channels[0].supervision;
  DOUBLES_EQUAL(0.02, s.out_of_range_s, 1e-12);
  DOUBLES_EQUAL(0.03, s.open_s, 1e-12);
  DOUBLES_EQUAL(0.02, s.wrong_duty_s, 1e-12);
  DOUBLES_EQUAL(0.03, c.settings.channels[0].position.max_age_s, 1e-12);
}

TEST(BoardConfig, AShortMustLastTwoTicksWhereItsCurrentMayBeOfAnotherTick) {
  const auto short_s = [](const BoardConfig& c) {
    return c.settings.channels[0].supervision.short_s;
  };
  const std::string slow = test::small_board_with("charge_pump_decay_ms = 20",
                                                  "charge_pump_decay_ms = 150\nrate_Hz = 100");
  const auto with = [](std::string text, const std::string& old, const std::string& replacement) {
    return text.replace(text.find(old), old.size(), replacement);
  };
  const std::string behind_a_bus = with(slow, "number = 0", "number = 0, bus = 'i2c-1'");
  const std::string current = "input = \"voltage2\"\n";
  DOUBLES_EQUAL(0.01, short_s(read(slow)), 1e-12);
  DOUBLES_EQUAL(0.02, short_s(read(behind_a_bus)), 1e-12);
  for (const std::string& pwm : {slow, behind_a_bus})
    DOUBLES_EQUAL(0.02, short_s(read(with(pwm, current, current + "bus = 'i2c-1'\n"))), 1e-12);
  DOUBLES_EQUAL(0.02, short_s(example("raspberry-pi-pca9685-ads1115.toml")), 1e-12);
}

TEST(BoardConfig, DescriptionNamesIneffectiveDetectors) {
  const std::string quiet =
      describe(read(test::small_board_with("max_m = 0.041", "max_m = 0.041\nnoise_rms_m = 0.0")));
  check_says(quiet,
             "channel 1: sensor_frozen: position.noise_rms_m is 0, and a frozen sensor looks like "
             "a quiet one\n");
  check_says(quiet, "channel 1: sensors_disagree: ");
  check_says(quiet, "board: no watchdog: ");
  const std::string coarse = describe(
      read(test::small_board_with("A_per_count = 0.0001", "A_per_count = 0.005\noff_A = 0.001")));
  check_says(coarse, "channel 1: resistance_drift: a probe's 21.6 mA is only 4.32 counts");
}

TEST(BoardConfig, ThermalFuseIsRequestedAndComparedWithTheTrip) {
  const auto described = [](const std::string& fuse) {
    const std::string heater = "cold_resistance_Ohm = 10.0\n";
    return describe(read(test::small_board_with(heater, heater + fuse)));
  };
  check_says(described(""), "channel 1: thermal fuse: heater.thermal_fuse_C is not given");
  check_says(described("thermal_fuse_C = 0\n"), "channel 1: thermal fuse: none: nothing detects");
  check_says(described("thermal_fuse_C = 152.0\n"), "opens at 152 °C, below trip_C = 160 °C");
  check_says(described("thermal_fuse_C = 216\n"), "opens at 216 °C, more than 30 K above trip_C");
  for (const char* suits : {"160", "169", "190"}) {
    const std::string text = described("thermal_fuse_C = " + std::string(suits) + "\n");
    check_says(text, "its thermal fuse opens at " + std::string(suits) + " °C");
    CHECK_TEXT(text.find("thermal fuse: ") == std::string::npos, text.c_str());
  }
}

TEST(BoardConfig, DescriptionSaysWhatNarrowsTheTemperatureInterval) {
  check_says(describe(read(test::small_board)),
             "not weighed (thermal.weighed_mass_error_ratio): position and power give the time "
             "constant only; no thermometer was read (compare_rise)");
  BoardConfig weighed = read(test::small_board_with(
      "[channel.limits]",
      "weighed_mass_J_per_K = 0.16\nweighed_mass_error_ratio = 0.05\n[channel.limits]"));
  check_says(describe(weighed), "from 0.152 to 0.168 J/K and 0.045 to 0.18 W/K");
  check_says(describe(weighed), "weighed to 5 %; identify finds the time constant");
  weighed.settings.channels[0].heat = {1.8, 2.4, 21.5, 1.2, 1.5, 1.5};
  check_says(describe(weighed),
             "weighed to 5 %; time constant 1.8 s: 0.0676 to 0.117 W/K from 18.9 to 27 K above "
             "the air; 21.5 K above the air read at 1.5 W");
}

TEST(BoardConfig, MemoryCountsRingAndRecorder) {
  const Memory memory = memory_of(read(test::small_board).settings);
  UNSIGNED_LONGS_EQUAL(1 * 1000 * 112, memory.ring);
  UNSIGNED_LONGS_EQUAL(16 * 1000 * 112, memory.recorder);
  CHECK(memory.loop > 10000);
}

TEST(BoardConfig, CanIsOffByDefaultAndHasTheProtocolsRatesWhenOn) {
  CHECK_FALSE(read(test::small_board).can.has_value());
  check_says(describe(read(test::small_board)), "CAN: none");
  const BoardConfig c = read(test::small_board + "[can]\n");
  STRCMP_EQUAL("can0", c.can->interface.c_str());
  LONGS_EQUAL(1, c.can->first_node);
  DOUBLES_EQUAL(500e3, c.can->bit_rate, 0.0);
  DOUBLES_EQUAL(100.0, c.can->rates_Hz[0], 0.0);
  DOUBLES_EQUAL(1.0, c.can->lease_s, 1e-12);
}

TEST(BoardConfig, DescriptionHasTheLoadOfTheCanBus) {
  const std::string text = describe(
      read(test::small_board + "[can]\nfirst_node = 7\nrates = {status_Hz = 5.0, power_Hz = 0}\n"));
  check_says(text, "CAN on can0 at 500 kbit/s, nodes 7 to 7");
  check_says(text, "load    7.6 % at worst");
  check_says(text, "status 5 Hz");
}

TEST(BoardConfig, AirIsConfiguredAndMayBeMeasured) {
  check_says(describe(read(supercoil::test::small_board)),
             "air            15 to 30 °C, not measured");
  const BoardConfig c = read(supercoil::test::small_board_with("warmest_C = 30\n", R"(warmest_C = 30
[ambient.sensor]
device = "thermometer"
input = "temp"
bus = "i2c-1"
C_per_count = 0.0625
offset_C = -2
)"));
  STRCMP_EQUAL("thermometer", c.wiring.air->device.c_str());
  DOUBLES_EQUAL(0.0625, c.settings.air.scaling.per_count, 0.0);
  DOUBLES_EQUAL(-2.0, c.settings.air.scaling.offset, 0.0);
  DOUBLES_EQUAL(2.0, c.settings.channels[0].thermal.air.error_K, 0.0);
  check_says(describe(c), "measured to 2 K at temp of thermometer");
  check_says(describe(c), "air 0.1");  // ms of bus time
}

TEST(BoardConfig, PromisesAnErrorForLearnedFeedforwardOnly) {
  BoardConfig c = read(test::small_board);
  const BoardSettings& board = c.settings;
  ChannelSettings& channel = c.settings.channels[0];
  channel.controllers[0].kind = control::ControllerKind::pi;
  const auto of_pi = describe_promises(board, 0);
  LONGS_EQUAL(1, of_pi.size());
  check_says(of_pi[0], "controller 0 promises no error (pi); the recommended one promises, once ");
  channel.controllers[0].kind = control::ControllerKind::learned_ff;
  const auto of_learned = describe_promises(board, 0);
  check_says(of_learned[0], "controller 0 promises, once the muscle is identified, at most ");
  const FirstMotion motion = plan_first_motion(feasibility(channel, board), 0.0);
  const Promise promise = promise_error(channel.controllers[0].learned_ff, channel, board, motion);
  check_says(of_learned[0], describe_promise(promise, motion));
  channel.supervision.max_travel_m = 0.0;
  check_says(describe_promises(board, 0)[0], "no error is promised");
}

TEST(BoardConfig, RecommendsAControllerOrNamesAConfiguredOne) {
  BoardConfig c = read(test::small_board);
  ChannelSettings& channel = c.settings.channels[0];
  const std::string law =
      "controller = { kind = \"learned_ff\", shape_reference = true, bandwidth_rad_per_s = 8 }";
  const std::string model =
      "reference_model = { kind = \"poles\", poles_rad_per_s = [3.276, 3.276, 3.276] }";
  check_says(describe(c), "\n  recommended " + law + ": follows closest");
  check_says(describe(c), "\n              " + model + ": as fast as a step of");
  channel.controllers.push_back(
      recommended_controller(channel.muscle).applied_to(channel.controllers[0]));
  check_says(describe(c), "\n  recommended controller 1, as configured: it follows closest");
  channel.bundle.leader_offset = -1;
  CHECK(describe_recommendation(c.settings, 0).empty());
}

TEST(BoardConfig, AdvisesLeastSquaresForAdaptiveFeedforward) {
  BoardConfig c = read(test::small_board_with("min_m = -0.001", "min_m = -0.03"));
  ChannelSettings& channel = c.settings.channels[0];
  channel.controllers[0].kind = control::ControllerKind::adaptive_ff;
  channel.estimators[0].kind = control::EstimatorKind::gradient;
  channel.supervision.max_travel_m = 3.0 * feasibility(channel, c.settings).travel_m;
  LONGS_EQUAL(1, advice(c).size());
  check_says(advice(c)[0], "adaptive_ff needs an estimator of kind least_squares");
  channel.estimators[0].kind = control::EstimatorKind::least_squares;
  CHECK(advice(c).empty());
}

TEST(BoardConfig, AdvisesWhenLittleOfTheTravelCanBeHeld) {
  BoardConfig c = read(test::small_board_with("min_m = -0.001", "min_m = -0.03"));
  ChannelSettings& channel = c.settings.channels[0];
  const Feasibility f = feasibility(channel, c.settings);
  check_says(describe(c), "and holds up to " + number_text(1e3 * f.cold_travel_m, 3) +
                              " mm above its zero there");
  channel.supervision.max_travel_m = 3.9 * f.travel_m;
  CHECK(advice(c).empty());
  channel.supervision.max_travel_m = 4.1 * f.travel_m;
  LONGS_EQUAL(1, advice(c).size());
  check_says(advice(c)[0], "indefinitely (limited_by unproven): senses compared");
  channel.supervision.max_travel_m = 0.025;
  channel.thermal.air.coldest_C -= 9.0;
  LONGS_EQUAL(1, advice(c).size());
  check_says(advice(c)[0], "in the coldest air it holds no more than ");
}

TEST(BoardConfig, AdviceNamesChannelsAndWhatToChange) {
  // The example's sensor ends 1 mm below zero, so it does not see a muscle in cold air.
  check_says(describe(example("raspberry-pi-pca9685-ads1115.toml")),
             "\nadvice\n  channels 1, 2, 3, 4: in the coldest air it rests 8.06 mm below its zero, "
             "and the sensor reads no less than -1 mm");
  const BoardConfig seen = read(test::small_board_with("min_m = -0.001", "min_m = -0.01"));
  CHECK(advice(seen).empty());
  CHECK_TEXT(describe(seen).find("\nadvice") == std::string::npos, describe(seen).c_str());
}
