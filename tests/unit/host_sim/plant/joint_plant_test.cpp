#include "plant/joint_plant.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "plant/nonlinear_plant.hpp"
#include "unit/control/support/reference.hpp"
#include "unit/host_sim/plant/support.hpp"

using namespace supercoil;
using host_sim::JointMuscle;
using host_sim::JointPlant;
using host_sim::JointPlantSettings;
using host_sim::NonlinearPlant;

namespace {

constexpr double joint_tick_s = 1e-3;

JointPlantSettings equal_muscles() {
  JointPlantSettings settings;
  settings.antagonist = JointMuscle{};
  return settings;
}

JointPlantSettings settings_from(const nlohmann::json& c) {
  const auto& joint = c.at("joint");
  JointPlantSettings settings;
  settings.lever = control::Lever(joint.at("lever_m").get<double>());
  const auto table_m = joint.at("table_m").get<std::vector<double>>();
  if (!table_m.empty())
    settings.lever = control::Lever(joint.at("table_rad")[0], joint.at("table_rad")[1], table_m);
  settings.inertia_kg_m2 = joint.at("inertia_kg_m2");
  settings.damping_Nms_per_rad = joint.at("damping_Nms_per_rad");
  settings.spring_Nm_per_rad = joint.at("spring_Nm_per_rad");
  settings.pretension_N = joint.at("pretension_N");
  settings.friction_ratio = joint.at("friction_ratio");
  settings.weight_Nm = joint.at("weight_Nm");
  settings.antagonist_lever_ratio = joint.at("antagonist_lever_ratio");
  const auto muscle = [&c](std::size_t i) {
    return JointMuscle{test::parameters_from(c.at("muscles")[i]),
                       test::effects_from(c.at("effects"))};
  };
  settings.agonist = muscle(0);
  if (c.at("muscles").size() > 1) settings.antagonist = muscle(1);
  return settings;
}

struct JointDeviations {
  test::Deviation angle;
  test::Deviation velocity;
  test::Deviation rise;
  test::Deviation tension;
};

/// Deviations at the end of each hold of a case.
JointDeviations joint_deviations(JointPlant& plant, double tick_s, const nlohmann::json& c) {
  const auto ticks = std::lround(c.at("hold_s").get<double>() / tick_s);
  JointDeviations found;
  for (std::size_t hold = 0; hold < c.at("power_W").size(); ++hold) {
    const auto& power_W = c.at("power_W")[hold];
    for (long tick = 0; tick < ticks; ++tick)
      plant.step(power_W[0], power_W[1], c.at("load_Nm")[hold]);
    found.angle.add(plant.angle_rad(), c.at("angle_rad")[hold]);
    found.velocity.add(plant.velocity_rad_per_s(), c.at("velocity_rad_per_s")[hold]);
    for (std::size_t i = 0; i < 2; ++i) {
      found.rise.add(plant.temperature_rise_K(i), c.at("temperature_rise_K")[hold][i]);
      found.tension.add(plant.tension_N(i), c.at("tension_N")[hold][i]);
    }
  }
  return found;
}

}  // namespace

TEST_GROUP(JointPlant){};

TEST(JointPlant, AgreesWithAnIndependentSolver) {
  const nlohmann::json cases = test::reference("joint", "cases");
  CHECK(cases.size() >= 12);
  for (const auto& c : cases) {
    const std::string name = c.at("name");
    // When a muscle becomes slack, its spring and damper end within a step of the mechanics.
    const bool smooth = name.rfind("slack", 0) != 0;
    JointPlant plant(settings_from(c), joint_tick_s);
    const JointDeviations found = joint_deviations(plant, joint_tick_s, c);
    CHECK_COMPARE_TEXT(found.rise.relative(), <, 1e-6, name.c_str());
    CHECK_COMPARE_TEXT(found.angle.relative(), <, smooth ? 1e-6 : 1e-4, name.c_str());
    CHECK_COMPARE_TEXT(found.tension.relative(), <, smooth ? 1e-6 : 1e-4, name.c_str());
    CHECK_COMPARE_TEXT(found.velocity.relative(), <, smooth ? 1e-5 : 2e-3, name.c_str());
  }
}

TEST(JointPlant, EqualMusclesAtEqualPowersBalance) {
  JointPlantSettings settings = equal_muscles();
  settings.weight_Nm = 0.01;
  settings.friction_ratio = 0.02;
  JointPlant plant(settings, joint_tick_s);
  for (int tick = 0; tick < 20000; ++tick) {
    const double power_W = tick % 3000 < 1500 ? 4.5 : 0.5;
    plant.step(power_W, power_W);
    DOUBLES_EQUAL(0.0, plant.angle_rad(), 1e-15);
  }
  CHECK_COMPARE(plant.tension_N(0), >, settings.pretension_N);
  DOUBLES_EQUAL(plant.tension_N(0), plant.tension_N(1), 1e-15);
}

TEST(JointPlant, SwappingTheMusclesMirrorsTheAngle) {
  JointPlantSettings settings = equal_muscles();
  settings.weight_Nm = 0.005;
  settings.friction_ratio = 0.02;
  settings.antagonist->parameters.stiffness_N_per_m = 24.0;
  settings.antagonist->effects.creep_ratio = 0.1;
  JointPlantSettings mirrored = settings;
  std::swap(mirrored.agonist, *mirrored.antagonist);
  JointPlant plant(settings, joint_tick_s);
  JointPlant mirror(mirrored, joint_tick_s);
  double furthest_rad = 0.0;
  for (int tick = 0; tick < 20000; ++tick) {
    const double power_W = tick % 3000 < 1500 ? 4.5 : 0.5;
    const double load_Nm = tick > 10000 ? 0.005 : 0.0;
    plant.step(power_W, 1.0, load_Nm);
    mirror.step(1.0, power_W, -load_Nm);
    DOUBLES_EQUAL(plant.angle_rad(), -mirror.angle_rad(), 1e-12);
    DOUBLES_EQUAL(plant.tension_N(0), mirror.tension_N(1), 1e-12);
    furthest_rad = std::fmax(furthest_rad, std::abs(plant.angle_rad()));
  }
  CHECK_COMPARE(furthest_rad, >, 0.1);
}

/// T0 + F1 - k1 (x + s) = T0 + F2 - k2 (-x), while both are taut.
TEST(JointPlant, CableSlackIsSharedByBothSpringsWhileBothAreTaut) {
  JointPlantSettings settings = equal_muscles();
  settings.agonist.parameters.stiffness_N_per_m = 16.0;
  settings.antagonist->parameters.stiffness_N_per_m = 24.0;
  settings.agonist.slack_m = 0.004;
  JointPlant plant(settings, joint_tick_s);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(0.0, 0.0);
  const double expected_m = -16.0 * 0.004 / (16.0 + 24.0);
  DOUBLES_EQUAL(expected_m, plant.position_m(), 1e-9);
  DOUBLES_EQUAL(settings.pretension_N + 24.0 * expected_m, plant.tension_N(0), 1e-9);
  DOUBLES_EQUAL(plant.tension_N(0), plant.tension_N(1), 1e-9);
}

TEST(JointPlant, ASlackMuscleMovesNothingUntilTheSlackIsTakenUp) {
  JointPlantSettings settings = equal_muscles();
  settings.pretension_N = 0.0;
  settings.spring_Nm_per_rad = 0.01;  // holds the joint when no muscle pulls
  settings.agonist.slack_m = 0.004;
  const control::PhysicalParameters& muscle = settings.agonist.parameters;
  // These contract the free muscle by half the slack, and by twice the slack.
  const double slack_W = 0.004 * muscle.stiffness_N_per_m * muscle.heat_transfer_W_per_K /
                         muscle.force_per_kelvin_N_per_K;
  JointPlant plant(settings, joint_tick_s);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(0.5 * slack_W, 0.0);
  DOUBLES_EQUAL(0.0, plant.angle_rad(), 1e-12);
  DOUBLES_EQUAL(0.0, plant.tension_N(0), 0.0);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(2.0 * slack_W, 0.0);
  // F - k (x + s) = k x + (spring/r²) x with F = 2 k s: both muscles are taut.
  const double k = muscle.stiffness_N_per_m;
  const double spring = 0.01 / (0.015 * 0.015);
  DOUBLES_EQUAL(k * 0.004 / (2.0 * k + spring), plant.position_m(), 1e-6);
}

TEST(JointPlant, ATornMuscleDoesNotPullAndStillHeats) {
  JointPlantSettings settings = equal_muscles();
  JointPlant plant(settings, joint_tick_s);
  DOUBLES_EQUAL(0.0, plant.angle_rad(), 0.0);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(1.0, 1.0);
  const double rise_K = plant.temperature_rise_K(1);
  settings.antagonist->torn = true;
  plant.set(settings);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(1.0, 1.0);
  DOUBLES_EQUAL(0.0, plant.tension_N(1), 0.0);
  DOUBLES_EQUAL(rise_K, plant.temperature_rise_K(1), 1e-3);
  // Nothing holds the agonist.
  DOUBLES_EQUAL(settings.max_angle_rad, plant.angle_rad(), 0.0);
}

TEST(JointPlant, RestsOnItsEndStopsAndLeavesThem) {
  JointPlantSettings settings = equal_muscles();
  settings.min_angle_rad = -0.1;
  settings.max_angle_rad = 0.2;
  JointPlant plant(settings, joint_tick_s);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(4.5, 0.0);
  DOUBLES_EQUAL(0.2, plant.angle_rad(), 1e-15);
  DOUBLES_EQUAL(0.0, plant.velocity_rad_per_s(), 0.0);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(0.0, 4.5);
  DOUBLES_EQUAL(-0.1, plant.angle_rad(), 1e-15);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(0.0, 0.0);
  DOUBLES_EQUAL(0.0, plant.angle_rad(), 1e-3);
}

TEST(JointPlant, MusclesHeatAsTheyDoAlone) {
  JointPlantSettings settings = equal_muscles();
  settings.antagonist->effects = test::real_muscle();
  JointPlant plant(settings, joint_tick_s);
  NonlinearPlant linear({}, {}, joint_tick_s);
  NonlinearPlant real({}, test::real_muscle(), joint_tick_s);
  for (int tick = 0; tick < 20000; ++tick) {
    const double power_W = tick % 3000 < 1500 ? 4.5 : 0.5;
    plant.step(power_W, 5.0 - power_W);
    linear.step(power_W);
    real.step(5.0 - power_W);
    DOUBLES_EQUAL(linear.temperature_rise_K(), plant.temperature_rise_K(0), 0.0);
    DOUBLES_EQUAL(real.temperature_rise_K(), plant.temperature_rise_K(1), 0.0);
  }
}

TEST(JointPlant, CoContractionDoesNotStiffenLinearMusclesAndSoftensRealOnes) {
  const auto turned_rad = [](const host_sim::PlantEffects& effects, double each_W) {
    JointPlantSettings settings = equal_muscles();
    settings.agonist.effects = settings.antagonist->effects = effects;
    JointPlant plant(settings, joint_tick_s);
    for (int tick = 0; tick < 60000; ++tick)
      plant.step(each_W, each_W, 0.003);
    return plant.angle_rad();
  };
  const double expected_rad = -0.003 / (0.015 * 0.015 * 2.0 * 16.0);
  DOUBLES_EQUAL(expected_rad, turned_rad({}, 0.0), 1e-8);
  DOUBLES_EQUAL(expected_rad, turned_rad({}, 4.0), 1e-8);
  host_sim::PlantEffects softens;
  softens.softening_ratio = 0.4;
  DOUBLES_EQUAL(expected_rad, turned_rad(softens, 0.0), 1e-8);
  DOUBLES_EQUAL(expected_rad / 0.6, turned_rad(softens, 6.0), 1e-8);
}

/// At rest the springs take the muscles' moment less that of the arm of 40 g at 15 mm.
TEST(JointPlant, AWeightPullsTheArmDownWithTheSineOfItsAngle) {
  JointPlantSettings settings = equal_muscles();
  const double arm_m = 0.015;
  settings.weight_Nm = 0.040 * host_sim::gravity_m_per_s2 * arm_m;
  const control::PhysicalParameters& p = settings.agonist.parameters;
  const double lever_m = settings.lever.zero_radius_m();
  JointPlant plant(settings, joint_tick_s);
  double before_rad = 0.0;
  for (const double power_W : {0.5, 2.0, 4.0}) {
    for (int tick = 0; tick < 60000; ++tick)
      plant.step(power_W, 0.0);
    const double turned_rad = plant.angle_rad();
    const double muscle_Nm =
        lever_m * p.force_per_kelvin_N_per_K * power_W / p.heat_transfer_W_per_K;
    const double spring_Nm = 2.0 * p.stiffness_N_per_m * lever_m * lever_m * turned_rad;
    DOUBLES_EQUAL(muscle_Nm - settings.weight_Nm * std::sin(turned_rad), spring_Nm, 1e-9);
    CHECK_COMPARE(turned_rad, >, before_rad + 0.05);
    before_rad = turned_rad;
  }
}

/// The muscle's pull balances the arm's moment at every angle; at 0 the cold muscle's pull does.
TEST(JointPlant, OneMuscleLiftsAnArmThatItsWeightPullsBack) {
  JointPlantSettings settings;
  const double lever_m = settings.lever.zero_radius_m();
  settings.weight_Nm = 0.005;
  settings.hangs_at_rad = -0.8;
  settings.spring_pretensions = false;
  settings.pretension_N = settings.weight_Nm * std::sin(0.8) / lever_m;
  JointPlant plant(settings, joint_tick_s);
  const control::PhysicalParameters& p = settings.agonist.parameters;
  double before_rad = -1e-9;
  for (const double power_W : {0.0, 0.5, 1.5}) {
    for (int tick = 0; tick < 60000; ++tick)
      plant.step(power_W, 0.0);
    const double turned_rad = plant.angle_rad();
    if (power_W == 0.0) DOUBLES_EQUAL(0.0, turned_rad, 1e-9);
    const double weight_N = settings.weight_Nm * std::sin(turned_rad + 0.8) / lever_m;
    DOUBLES_EQUAL(weight_N, plant.tension_N(0), 1e-9);
    const double heat_N = p.force_per_kelvin_N_per_K * power_W / p.heat_transfer_W_per_K;
    DOUBLES_EQUAL(settings.pretension_N + heat_N - p.stiffness_N_per_m * lever_m * turned_rad,
                  weight_N, 1e-9);
    CHECK_COMPARE(turned_rad, >, before_rad);
    before_rad = turned_rad + 0.05;
  }
}

/// At the angle 0 the cold muscles are in balance, each at its own lever.
TEST(JointPlant, AngleBalancesTheForcesAtBothLevers) {
  JointPlantSettings settings = equal_muscles();
  settings.antagonist_lever_ratio = 0.5;
  const control::PhysicalParameters& p = settings.agonist.parameters;
  JointPlant plant(settings, joint_tick_s);
  const auto settle = [&](double agonist_W, double antagonist_W) {
    for (int tick = 0; tick < 60000; ++tick)
      plant.step(agonist_W, antagonist_W);
  };
  settle(0.0, 0.0);
  DOUBLES_EQUAL(0.0, plant.angle_rad(), 1e-12);
  DOUBLES_EQUAL(2.0 * plant.tension_N(0), plant.tension_N(1), 1e-12);
  settle(1.0, 1.5);
  const double agonist_m = settings.lever.zero_radius_m();
  const double antagonist_m = 0.5 * agonist_m;
  const double N_per_W = p.force_per_kelvin_N_per_K / p.heat_transfer_W_per_K;
  const double turning_Nm = N_per_W * (1.0 * agonist_m - 1.5 * antagonist_m);
  const double stiffness_Nm =
      p.stiffness_N_per_m * (agonist_m * agonist_m + antagonist_m * antagonist_m);
  DOUBLES_EQUAL(turning_Nm / stiffness_Nm, plant.angle_rad(), 1e-8);
  DOUBLES_EQUAL(-antagonist_m * plant.angle_rad(), plant.position_m(1), 1e-12);
}

TEST(JointPlant, TakesCoarseTicksAsWellAsFineOnes) {
  JointPlantSettings settings = equal_muscles();
  settings.agonist.effects = settings.antagonist->effects = test::real_muscle();
  settings.weight_Nm = 0.005;
  JointPlant fine(settings, 1e-3);
  JointPlant coarse(settings, 1e-2);
  for (int tick = 0; tick < 2000; ++tick) {
    const double power_W = tick % 300 < 150 ? 4.5 : 0.5;
    for (int i = 0; i < 10; ++i)
      fine.step(power_W, 1.0);
    coarse.step(power_W, 1.0);
    DOUBLES_EQUAL(fine.angle_rad(), coarse.angle_rad(), 1e-12);
  }
}

TEST(JointPlant, StaysFiniteForEveryMuscleThatIsAllowed) {
  for (int corner = 0; corner < 64; ++corner) {
    JointPlantSettings settings = equal_muscles();
    int bit = 0;
    for (const control::PhysicalRange& range : control::physical_ranges) {
      settings.agonist.parameters.*range.member =
          (corner >> bit++ & 1) != 0 ? range.max : range.min;
    }
    settings.antagonist->effects = test::real_muscle();
    settings.friction_ratio = corner % 3 == 0 ? 0.02 : 0.0;
    settings.weight_Nm = 0.01;
    JointPlant plant(settings, joint_tick_s);
    for (int tick = 0; tick < 300; ++tick)
      plant.step(tick < 150 ? 5.0 : 0.0, 1.0);
    CHECK(std::isfinite(plant.angle_rad()));
    CHECK(std::isfinite(plant.velocity_rad_per_s()));
    CHECK(std::isfinite(plant.temperature_rise_K(0)));
    CHECK(std::isfinite(plant.tension_N(0)));
  }
}
