// [plant] with effects and presets, and the settings of the board's senses that go with them.
#include <sstream>
#include <string>

#include <CppUTest/TestHarness.h>

#include "plant/presets.hpp"
#include "runner/board_of.hpp"
#include "scenario/read_scenario.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::problems;
using supercoil::test::read;

TEST_GROUP(PlantKeys){};

TEST(PlantKeys, AreAllOffByDefault) {
  const Scenario s = read("");
  CHECK_FALSE(s.start.plant.effects.any());
  CHECK_FALSE(s.start.plant.air_acts);
  DOUBLES_EQUAL(0.0, s.start.position_sensor.min_m, 0.0);
}

TEST(PlantKeys, EveryEffectHasAKey) {
  for (const EffectRange& range : effect_ranges) {
    // Between the default and the farther end of the range.
    const double fallback = PlantEffects{}.*range.member;
    const double end = range.max - fallback > fallback - range.min ? range.max : range.min;
    double value = fallback + 0.01 * (end - fallback);
    if (std::string(range.name) == "softening_from_K") value = fallback - 1.0;
    std::ostringstream text;
    text.precision(17);
    text << "plant." << range.name << " = " << std::fixed << value << '\n';
    const Scenario s = read(text.str());
    DOUBLES_EQUAL(value, s.start.plant.effects.*range.member, 1e-12);
  }
}

TEST(PlantKeys, APresetIsOverriddenByTheKeysBesideIt) {
  const Scenario s =
      read("[plant]\npreset = 'b'\nhysteresis_ratio = 0.1\nstiffness_N_per_m = 30.0\n");
  const PresetMuscle b = preset_muscle(MusclePreset::b);
  PlantEffects effects = b.effects;
  effects.hysteresis_ratio = 0.1;
  CHECK(effects == s.start.plant.effects);
  control::PhysicalParameters parameters = b.parameters;
  parameters.stiffness_N_per_m = 30.0;
  CHECK(parameters == s.start.plant.parameters);
  CHECK(parameters == s.start.muscle);
  CHECK(s.start.plant.air_acts);
}

TEST(PlantKeys, AHeavierLoadHangsFromTheMuscle) {
  DOUBLES_EQUAL(0.2, read("plant.moving_mass_kg = 0.2").start.plant.effects.hanging_mass_kg, 0.0);
}

TEST(PlantKeys, AnEventChangesAnyOfThemButNotTheSensor) {
  const Scenario s = read(
      "[[event]]\nat_s = 1.0\nplant.draught_ratio = 2.0\n"
      "[[event]]\nat_s = 2.0\nplant.preset = 'real_hard'\n");
  DOUBLES_EQUAL(2.0, s.events[0].conditions.plant.effects.draught_ratio, 0.0);
  DOUBLES_EQUAL(0.15, s.events[1].conditions.plant.effects.hysteresis_ratio, 0.0);
  DOUBLES_EQUAL(2.0, s.events[1].conditions.plant.effects.draught_ratio, 0.0);
  DOUBLES_EQUAL(0.0, s.events[1].conditions.position_sensor.min_m, 0.0);
  DOUBLES_EQUAL(-0.01, read("plant.preset = 'real'").start.position_sensor.min_m, 1e-12);
}

TEST(PlantKeys, ErrorsNameTheAllowedRange) {
  STRCMP_EQUAL("s.toml:1: plant.force_ratio = 50: must be 0.1 to 20\n",
               problems("plant.force_ratio = 50.0").c_str());
  STRCMP_EQUAL("s.toml:1: plant.preset = 'soft': must be one of: paper, real, real_hard, b, c\n",
               problems("plant.preset = 'soft'").c_str());
  STRCMP_EQUAL("s.toml:3: plant.radiation_ratio = 0.5: must be 0 to 0.4 with the other values\n",
               problems("[plant]\nconvection_ratio = 0.6\nradiation_ratio = 0.5").c_str());
  STRCMP_EQUAL(
      "s.toml:2: sensor.position.count_m = 2e-05: cannot be combined with resolution_bits: "
      "both set the size of a count\n",
      problems("[sensor.position]\ncount_m = 20e-6\nresolution_bits = 12").c_str());
}

TEST(PlantKeys, TheAirActsOnlyWhenEnabled) {
  const std::string event = "[[event]]\nat_s = 1.0\nambient.air_C = 35.0\n";
  const Scenario stays = read(event);
  CHECK_FALSE(muscle_channel_of(stays, stays.events[0].conditions).effects.any());
  const Scenario acts = read("plant.air_acts = true\n" + event);
  const auto settings = muscle_channel_of(acts, acts.events[0].conditions);
  DOUBLES_EQUAL(10.0, settings.effects.air_change_K, 1e-12);
  DOUBLES_EQUAL(25.0, settings.rise_from_C, 1e-12);
}
