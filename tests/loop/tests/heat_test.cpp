// The interval that the firmware publishes contains the muscle's temperature, and no muscle passes
// the limit.
#include <algorithm>
#include <string>

#include <CppUTest/TestHarness.h>

#include "loop/support/rig.hpp"
#include "loop/support/situations.hpp"
#include "runner/simulation.hpp"
#include "scenario/builtin.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using namespace supercoil::test;

namespace {

constexpr double trip_C = 160.0;
/// A muscle that may be heated with 4.5 W warms by less than this from crossing the limit until the
/// heater is off.
constexpr double overshoot_K = 0.1;

struct Heat {
  long outside_ticks = 0;
  double widest_K = 0.0;
  double hottest_C = 0.0;
  Fault fault = Fault::none;
};

Heat heat_of(const Scenario& scenario) {
  Simulation simulation(scenario);
  Heat heat;
  while (!simulation.done()) {
    const TickRecord r = simulation.step();
    const bool inside =
        r.temperature_rise_K >= r.coldest_K - 1e-9 && r.temperature_rise_K <= r.hottest_K + 1e-9;
    heat.outside_ticks += inside ? 0 : 1;
    heat.widest_K = std::fmax(heat.widest_K, r.hottest_K - r.coldest_K);
    if (r.fault != Fault::none) heat.fault = r.fault;
  }
  heat.hottest_C = scenario.start.ambient.air_C + simulation.plant().peak_temperature_rise_K();
  return heat;
}

Scenario read(const std::string& text) {
  auto scenario = parse_scenario(text, "heat.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  return *scenario;
}

void check_contained(const std::string& what, const Scenario& scenario) {
  const Heat heat = heat_of(scenario);
  printf("%-28s hottest %6.1f C, interval at most %5.1f K wide, outside %ld ticks\n", what.c_str(),
         heat.hottest_C, heat.widest_K, heat.outside_ticks);
  LONGS_EQUAL(0, heat.outside_ticks);
  CHECK_COMPARE(heat.hottest_C, <, trip_C + overshoot_K);
}

const char* sine = "simulation.duration_s = 120.0\ncontroller.kind = 'mrac'\n";

}  // namespace

TEST_GROUP(Heat){};

TEST(Heat, IsContainedInEveryBuiltInScenario) {
  for (const BuiltinScenario& builtin : builtin_scenarios()) {
    Scenario scenario =
        parse_scenario(std::string(builtin.text), std::string(builtin.name)).value();
    // "bench" waits for a day.
    scenario.duration_s = std::min(scenario.duration_s, 300.0);
    check_contained(std::string(builtin.name), scenario);
  }
}

TEST(Heat, IsContainedWhenTheMuscleChangesMidRun) {
  const std::string event = "[[event]]\nat_s = 60.0\n";
  check_contained("gamma halved", read(sine + event + "plant.force_per_kelvin_N_per_K = 0.0043\n"));
  check_contained("load mass doubled", read(sine + event + "plant.moving_mass_kg = 0.18\n"));
  check_contained("both", read(sine + event +
                               "plant.force_per_kelvin_N_per_K = 0.0043\n"
                               "plant.moving_mass_kg = 0.18\n"));
  check_contained("eta x 2", read(sine + event + "plant.heat_transfer_W_per_K = 0.178\n"));
  check_contained("eta x 0.5", read(sine + event + "plant.heat_transfer_W_per_K = 0.0445\n"));
  check_contained("psi x 1.3", read(sine + event + "plant.thermal_mass_J_per_K = 0.21\n"));
  check_contained("psi x 0.8", read(sine + event + "plant.thermal_mass_J_per_K = 0.13\n"));
  check_contained("power + 5 %", read(sine + ("thermal.power_ratio = [1.0, 1.05]\n" + event) +
                                      "power.gain = 1.05\n"));
  check_contained("load -0.05 N", read(sine + event + "plant.load_N = 0.05\n"));
  check_contained("stiffness 16 -> 12", read(sine + event + "plant.stiffness_N_per_m = 12.0\n"));
}

TEST(Heat, StaysBelowTheLimitAtExcessiveDemand) {
  const std::string greedy =
      "simulation.duration_s = 120.0\npower.max_W = 14.0\ncontroller.kind = 'power'\n"
      "reference = {kind = 'power', offset_W = 14.0, amplitudes_W = [0.0], "
      "angular_frequencies_rad_per_s = [1.0]}\nsensor.position.range_m = 0.2\n";
  check_contained("14 W asked for", read(greedy));
  check_contained("14 W, badly cooled",
                  read(greedy + "[plant]\nheat_transfer_W_per_K = 0.0445\n[muscle]\n"
                                "heat_transfer_W_per_K = 0.089\n"));
}

TEST(Heat, MaxPowerIsAFaultOnlyWithAnEnergyBudget) {
  // docs/safety.md states both times.
  const std::string held =
      "simulation.duration_s = 300.0\ncontroller.kind = 'power'\n"
      "thermal.transfer_ratio = [0.7, 2.2]\n"  // otherwise derated: controller_invalid
      "reference = {kind = 'power', offset_W = 4.5, amplitudes_W = [0.0], "
      "angular_frequencies_rad_per_s = [1.0]}\n";
  const Heat heat = heat_of(read(held));
  CHECK(heat.fault == Fault::none);
  test::RigSettings settings = test::rough_board();
  settings.firmware.channels[0].supervision.energy_J = 240.0;
  settings.firmware.channels[0].thermal.bounds.min_transfer_W_per_K = 0.08;  // not derated
  settings.firmware.channels[0].senses.error_ratio = 0.02;
  settings.firmware.channels[0].supervision.max_travel_m = 0.042;
  test::Rig rig(settings);
  rig.boot();
  rig.arm();
  rig.run(0.2);
  const double start_s = rig.time_s();
  rig.scale = 1.799;  // 4.5 W
  rig.heat(test::Task::power);
  CHECK(rig.run_until([&] { return rig.state() == State::fault; }, 200.0));
  CHECK(rig.fault() == Fault::energy_budget_exceeded);
  DOUBLES_EQUAL(132.0, rig.time_s() - start_s, 3.0);
}

TEST(Heat, IsCutWhenTheCurrentSenseReadsTooLow) {
  // The sense's gain falls to a third: unnoticed, the power stage would give three times as much.
  test::RigSettings settings = test::rough_board();
  settings.firmware.channels[0].heater.temperature_coefficient_per_K = 0.0;
  settings.board.channels[0].temperature_coefficient_per_K = 0.0;
  test::Rig rig(settings);
  test::bring_to(test::Situation::power, rig);
  ConverterSettings weak = rig.muscle().current.settings();
  weak.high = weak.low + 3.0 * (weak.high - weak.low);
  weak.low *= 3.0;
  rig.muscle().current.set(weak);
  CHECK(rig.run_until([&] { return rig.state() == State::fault; }, 2.0));
  CHECK(rig.fault() == Fault::resistance_drift);
}

TEST(Heat, IsContainedAfterEveryHeaterFault) {
  for (const char* faults : {"switch_stuck_on", "heater_open", "heater_short", "pwm_refuses"}) {
    check_contained(faults, read(sine + std::string("[[event]]\nat_s = 60.0\ninjected_fault.") +
                                 faults + " = true\n"));
  }
}

namespace {

/// Senses that lie, on a muscle so stiff that 11 W hardly move it.
struct SenseGains {
  double supply_gain = 1.0;  ///< measured over true
  double current_gain = 1.0;
  bool compared = false;  ///< the board believes that they were compared with a meter
};

/// Makes a converter read `gain` times the truth without the board knowing.
void scale(ConverterSettings& converter, double gain) {
  converter.low /= gain;
  converter.high /= gain;
}

Heat heat_of_power(const SenseGains& senses, double power_W) {
  test::RigSettings settings = test::rough_board();
  // A range so wide that 0.83 times 12 V is no fault.
  settings.firmware.supervision.min_supply_V = 9.0;
  settings.firmware.supervision.max_supply_V = 15.0;
  for (std::size_t i = 0; i < 2; ++i) {
    MuscleChannelSettings& muscle = settings.board.channels[i];
    muscle.plant.stiffness_N_per_m = 64.0;
    muscle.temperature_coefficient_per_K = 0.0;
    ChannelSettings& channel = settings.firmware.channels[i];
    channel.muscle = muscle.plant;
    // As badly cooled and as light as the board's bounds allow.
    muscle.plant.heat_transfer_W_per_K = channel.thermal.bounds.min_transfer_W_per_K;
    muscle.plant.thermal_mass_J_per_K = channel.thermal.bounds.min_mass_J_per_K;
    channel.heater.temperature_coefficient_per_K = 0.0;
    channel.limiter.max_W = 11.0;
    channel.supervision.max_measured_W = 14.0;
    channel.supervision.energy_J = 1e4;
    if (senses.compared) channel.senses.error_ratio = 0.02;
    scale(muscle.current, senses.current_gain);
  }
  scale(settings.board.supply, senses.supply_gain);
  test::Rig rig(settings);
  rig.boot();
  rig.arm();
  rig.run(0.1);
  rig.heat(test::Task::nothing);
  Heat heat;
  for (int tick = 0; tick < 60'000 && rig.state() != State::fault; ++tick) {
    rig.send(Verb::power, power_W);
    rig.run_ticks(1);
    heat.hottest_C = std::fmax(heat.hottest_C, 25.0 + rig.muscle().plant().temperature_rise_K());
  }
  heat.fault = rig.fault();
  heat.outside_ticks = rig.interval_missed ? 1 : 0;
  return heat;
}

}  // namespace

TEST(Heat, IsContainedWithUncomparedSenses) {
  // Wrong by less than resistance_drift notices, in the direction that heats more.
  struct WrongGains {
    const char* what;
    SenseGains senses;
  };
  for (const WrongGains& wrong :
       {WrongGains{"current x 0.78", {1.0, 0.78}}, WrongGains{"supply x 0.83", {0.83, 1.0}},
        WrongGains{"supply x 0.83, current x 0.64", {0.83, 0.64}},
        WrongGains{"both x 0.83", {0.83, 0.83}}}) {
    const Heat heat = heat_of_power(wrong.senses, 11.0);
    printf("%-28s hottest %6.1f C, fault %d\n", wrong.what, heat.hottest_C,
           static_cast<int>(heat.fault));
    LONGS_EQUAL(0, heat.outside_ticks);
    CHECK_COMPARE(heat.hottest_C, <, trip_C + overshoot_K);
  }
}

TEST(Heat, ComparedSensesAllowHotterOperation) {
  const Heat wide = heat_of_power({}, 11.0);
  const Heat narrow = heat_of_power({.compared = true}, 11.0);
  printf("hottest %.1f C, compared %.1f C\n", wide.hottest_C, narrow.hottest_C);
  LONGS_EQUAL(0, narrow.outside_ticks);
  CHECK_COMPARE(narrow.hottest_C, >, wide.hottest_C + 10.0);
  CHECK_COMPARE(narrow.hottest_C, <, trip_C);
}

TEST(Heat, IsContainedInMeasuredAirThatDiffersFromTheConfigured) {
  const std::string measured =
      "simulation.duration_s = 150.0\ncontroller.kind = 'pi'\nplant.air_acts = true\n"
      "ambient.sensor_error_K = 1.5\nambient.sensor_offset_K = ";
  const std::string events =
      "\n[[event]]\nat_s = 30.0\nambient.air_C = 45.0\n"
      "[[event]]\nat_s = 60.0\nambient.air_C = 5.0\n"
      "[[event]]\nat_s = 90.0\nambient.air_C = 70.0\n"
      "[[event]]\nat_s = 120.0\nambient.air_C = 25.0\n";
  for (const char* offset_K : {"-1.5", "0.0", "1.5"}) {
    const std::string text = std::string(measured).append(offset_K).append(events);
    check_contained(std::string("air, its sensor off by ") + offset_K, read(text));
  }
  // Where nothing measures the air, the truth leaves the interval: the test is not vacuous.
  const Heat blind =
      heat_of(read("simulation.duration_s = 150.0\ncontroller.kind = 'pi'\n"
                   "plant.air_acts = true" +
                   events));
  CHECK_COMPARE(blind.outside_ticks, >, 0);
}

TEST(Heat, FallsBackToTheConfiguredAirWhenItsSensorIsSilent) {
  RigSettings s = rough_board(1000.0);
  s.board.air = host_sim::ConverterSettings{.low = -60.0, .high = 140.0};
  s.firmware.air.scaling = {s.board.air->per_count(), s.board.air->low};
  for (ChannelSettings& channel : s.firmware.channels)
    channel.thermal.air = {40.0, 10.0, 1.0};
  Rig rig(s);
  const auto run = [&rig](double time_s) {
    for (int i = 0; i < static_cast<int>(1000.0 * time_s); ++i)
      rig.tick();
    return rig.loop.channel(0).snapshot();
  };
  const Snapshot read = run(60.0);
  DOUBLES_EQUAL(26.0, read.hottest_C, 0.1);
  DOUBLES_EQUAL(24.0, read.coldest_C, 0.1);
  rig.board.air->set({.silent = true});
  const Snapshot silent = run(1.0);
  DOUBLES_EQUAL(40.0, silent.hottest_C, 0.1);
  DOUBLES_EQUAL(10.0, silent.coldest_C, 0.1);
}
