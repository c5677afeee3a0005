// A slack muscle of a joint is reported, and avoided where it can be.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "loop/support/joint_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

/// Hardly stretched while they are cold, so that a load can take away all of a muscle's pull.
RigSettings loose_joint(double max_co_contraction_W, bool known) {
  constexpr double pretension_N = 0.02;
  RigSettings settings = known_joint(std::min(0.3, max_co_contraction_W));
  settings.board.joints[0].plant.pretension_N = pretension_N;
  JointSettings joint = settings.firmware.joints[0];
  joint.max_co_contraction_W = max_co_contraction_W;
  if (known) joint.pretension_N = pretension_N;
  // A load that grows by as much as the heat pulls hides that the muscles respond.
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.supervision.responding_min_m = 1.0;
  settings.firmware.joints.clear();
  add_joint(settings.firmware, joint);
  return settings;
}

}  // namespace

TEST_GROUP_BASE(JointSlack, JointCase) {
  /// Each muscle's values, at the end.
  struct Held {
    std::array<bool, 2> slack{};
    std::array<double, 2> pull_N{};
  };
  /// The load, in N at the lever, grows gradually and turns the joint to positive positions.
  static Held held(const RigSettings& settings, double position_m, double load_N) {
    Rig fresh(settings);
    begin(fresh);
    const auto holds = [&](double time_s) {
      CHECK_FALSE(faults_while_following(fresh, time_s, [=] { return position_m; }));
    };
    holds(20.0);
    host_sim::SimulatedJointSettings joint = fresh.board.joint(0).settings();
    for (int percent = 1; percent <= 100; ++percent) {
      joint.load_Nm = -0.01 * percent * load_N * lever_m;
      fresh.board.joint(0).set(joint);
      holds(0.5);
    }
    holds(60.0);
    Held held;
    for (std::uint8_t i = 0; i < 2; ++i) {
      held.slack.at(i) = fresh.loop.channel(i).snapshot().slack;
      held.pull_N.at(i) = fresh.board.joint(0).plant().tension_N(i);
    }
    return held;
  }
};

/// The muscle on the side to which the load turns the joint gets no power.
TEST(JointSlack, ReportsTheMuscleThatALoadSlackens) {
  for (const double way : {1.0, -1.0}) {
    const Held loaded = held(loose_joint(0.0, true), way * 4e-3, way * 0.25);
    const std::size_t loose = way > 0.0 ? agonist : antagonist;
    CHECK_TRUE(loaded.slack.at(loose));
    CHECK_FALSE(loaded.slack.at(1 - loose));
    DOUBLES_EQUAL(0.0, loaded.pull_N.at(loose), 0.0);
    DOUBLES_EQUAL(0.25, loaded.pull_N.at(1 - loose), 0.01);
  }
  const Held free = held(loose_joint(0.0, true), 4e-3, 0.0);
  for (const std::size_t i : {agonist, antagonist}) {
    CHECK_FALSE(free.slack.at(i));
    CHECK_COMPARE(free.pull_N.at(i), >, 0.0);
  }
}

TEST(JointSlack, IsNotReportedWithoutAKnownPretension) {
  const Held loaded = held(loose_joint(0.0, false), 4e-3, 0.25);
  DOUBLES_EQUAL(0.0, loaded.pull_N[agonist], 0.0);
  CHECK_FALSE(loaded.slack[agonist] || loaded.slack[antagonist]);
}

/// Both pull harder than was commanded, as far as max_co_contraction_W allows it.
TEST(JointSlack, IsAvoidedByCoContraction) {
  for (const double way : {1.0, -1.0}) {
    const std::size_t loose = way > 0.0 ? agonist : antagonist;
    const Held left = held(loose_joint(3.0, false), way * 4e-3, way * 0.25);
    DOUBLES_EQUAL(0.0, left.pull_N.at(loose), 0.0);
    const Held taut = held(loose_joint(3.0, true), way * 4e-3, way * 0.25);
    CHECK_FALSE(taut.slack.at(loose));
    CHECK_COMPARE(taut.pull_N.at(loose), >, 0.002);
    CHECK_COMPARE(taut.pull_N.at(loose), <, 0.03);
  }
}
