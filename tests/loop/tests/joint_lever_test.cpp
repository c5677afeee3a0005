// A joint whose lever depends on its angle.
#include <array>
#include <cmath>
#include <numbers>

#include "loop/support/joint_case.hpp"
#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

/// The muscles pull at levers that differ by a third over the travel.
RigSettings with_lever_table(RigSettings settings) {
  const std::array<double, 5> radii_m{0.011, 0.014, 0.015, 0.014, 0.012};
  const control::Lever lever(-0.6, 0.6, radii_m);
  settings.board.joints[0].plant.lever = lever;
  settings.firmware.joints[0].lever = lever;
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.joint.lever = lever;
  return settings;
}

}  // namespace

TEST_GROUP(JointLever){};

TEST(JointLever, TurnsToTheAngleWithALeverTable) {
  Rig turned(with_lever_table(joint_board()));
  begin(turned);
  const host_sim::JointPlant& plant = turned.board.joint(0).plant();
  for (const double wanted_deg : {22.0, -22.0}) {
    const double wanted_rad = wanted_deg / 180.0 * std::numbers::pi;
    const double position_m = plant.settings().lever.arc_m(wanted_rad);
    CHECK_COMPARE(std::abs(position_m), <, 0.97 * std::abs(wanted_deg * degree_m));
    CHECK_FALSE(faults_while_following(turned, 25.0, [=] { return position_m; }));
    DOUBLES_EQUAL(wanted_deg, plant.angle_rad() * 180.0 / std::numbers::pi, 0.05);
    DOUBLES_EQUAL(plant.position_m(), turned.loop.channel(agonist).snapshot().position_m, 30e-6);
    DOUBLES_EQUAL(-plant.position_m(), turned.loop.channel(antagonist).snapshot().position_m,
                  30e-6);
  }
  CHECK_FALSE(turned.interval_missed);
}

/// A sensor whose zero is 10 degrees away reads arcs from another place of the table.
TEST(JointLever, FindsItsZeroAwayFromTheTablesReference) {
  RigSettings settings = with_lever_table(joint_board());
  const double away_m = 10.0 * degree_m;
  settings.firmware.channels[agonist].position.scaling.offset += away_m;
  Rig shifted(settings);
  shifted.boot();
  shifted.arm();
  CHECK_COMPARE(std::abs(shifted.loop.channel(agonist).snapshot().position_m), <, 0.995 * away_m);
  shifted.run(60.0);
  CHECK(completes_mode(shifted, Verb::calibrate, 600.0));
  CHECK(shifted.loop.channel(agonist).snapshot().result == ModeResult::found);
  DOUBLES_EQUAL(away_m, shifted.loop.channel(agonist).known(known_position_offset), 10e-6);
}

/// The antagonist pulls at two thirds of the agonist's lever, and is described as it moves there.
TEST(JointLever, EachMuscleMayHaveItsOwnLever) {
  const auto scenario = host_sim::parse_scenario(
      "simulation.duration_s = 400.0\noperator.action = 'none'\ncontroller.kind = 'pi'\n"
      "[joint]\nantagonist_lever_m = 0.010\n"
      "[joint.antagonist]\nforce_per_kelvin_N_per_K = 0.0120\n",
      "joint.toml");
  CHECK(scenario.has_value());
  host_sim::Simulation joint(*scenario);
  Loop& loop = joint.loop();
  const auto run = [&](double time_s, double position_m) {
    for (long tick = 0; tick < std::lround(time_s * 1e3); ++tick) {
      loop.send({agonist, Verb::position, position_m});
      joint.step();
    }
  };
  loop.send({agonist, Verb::arm});
  joint.step();
  run(60.0, 0.0);
  // Co-contraction does not turn it: the controller has no effort to give.
  const double agonist_W = loop.channel(agonist).snapshot().applied_W;
  const double antagonist_W = loop.channel(antagonist).snapshot().applied_W;
  DOUBLES_EQUAL(0.015 * 0.0086 * agonist_W, 0.010 * 0.0120 * antagonist_W, 3e-6);
  DOUBLES_EQUAL(scenario->start.antagonist()->co_contraction_W, agonist_W, 0.03);
  // Its position is how far it has contracted.
  run(20.0, 0.003);
  DOUBLES_EQUAL(0.003, joint.joint()->position_m(), 20e-6);
  DOUBLES_EQUAL(-0.002, loop.channel(antagonist).snapshot().position_m, 40e-6);
  DOUBLES_EQUAL(-0.010, loop.channel(antagonist).known(known_joint_lever), 1e-9);
  CHECK(joint.step().fault == Fault::none);
}
