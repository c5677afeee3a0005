// A joint whose lever depends on its angle.
#include <array>
#include <cmath>
#include <numbers>

#include "loop/support/joint_case.hpp"

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

TEST(JointLever, TurnsToTheAngleAlsoWhereItsLeverDependsOnIt) {
  Rig turned(with_lever_table(joint_board()));
  begin(turned);
  const host_sim::JointPlant& plant = turned.board.joint(0).plant();
  for (const double wanted_deg : {22.0, -22.0}) {
    const double wanted_rad = wanted_deg / 180.0 * std::numbers::pi;
    const double position_m = plant.settings().lever.arc_m(wanted_rad);
    CHECK_COMPARE(std::abs(position_m), <, 0.97 * std::abs(wanted_deg * degree_m));
    CHECK_FALSE(follows_until_fault(turned, 25.0, [=] { return position_m; }));
    DOUBLES_EQUAL(wanted_deg, plant.angle_rad() * 180.0 / std::numbers::pi, 0.05);
    DOUBLES_EQUAL(plant.position_m(), turned.loop.channel(agonist).snapshot().position_m, 30e-6);
    DOUBLES_EQUAL(-plant.position_m(), turned.loop.channel(antagonist).snapshot().position_m,
                  30e-6);
  }
  CHECK_FALSE(turned.interval_missed);
}

/// A sensor whose zero is 10 degrees away reads arcs of another place of the table.
TEST(JointLever, FindsItsZeroWhereverTheLeverOfTheTableIs) {
  RigSettings settings = with_lever_table(joint_board());
  const double away_m = 10.0 * degree_m;
  settings.firmware.channels[agonist].position.scaling.offset += away_m;
  Rig shifted(settings);
  shifted.boot();
  shifted.arm();
  CHECK_COMPARE(std::abs(shifted.loop.channel(agonist).snapshot().position_m), <, 0.995 * away_m);
  shifted.run(60.0);
  CHECK(measures_to_the_end(shifted, Verb::calibrate, 600.0));
  CHECK(shifted.loop.channel(agonist).snapshot().result == ModeResult::found);
  DOUBLES_EQUAL(away_m, shifted.loop.channel(agonist).known(known_position_offset), 10e-6);
}
