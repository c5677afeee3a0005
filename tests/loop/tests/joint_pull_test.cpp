// Co-contraction: how hard both muscles of a joint pull against each other.
#include <array>
#include <cmath>
#include <cstdint>

#include "loop/joint.hpp"
#include "loop/support/joint_case.hpp"

using namespace supercoil;
using namespace supercoil::test;

TEST_GROUP_BASE(JointPull, JointCase){};

TEST(JointPull, AntagonistPowerSetsTheCoContractionWithoutTurningTheJoint) {
  arm();
  hold(5.0 * degree_m, 60.0);
  const host_sim::JointPlant& plant = rig.board.joint(0).plant();
  const double before_N = plant.tension_N(0) + plant.tension_N(1);
  const double before_W = of(antagonist).reference;
  CHECK(rig.answer_of(antagonist, Verb::power, 2.0 * before_W) == Refusal::none);
  hold(5.0 * degree_m, 3.0);
  const double soon_N = plant.tension_N(0) + plant.tension_N(1);
  double max_deg = 0.0;
  follow_for(
      60.0, [](double) { return 5.0 * degree_m; },
      [&] { max_deg = std::fmax(max_deg, std::abs(angle_deg() - 5.0)); });
  CHECK_COMPARE(max_deg, <, 0.1);
  const double after_N = plant.tension_N(0) + plant.tension_N(1);
  CHECK_COMPARE(after_N, >, before_N + 0.05);
  // Slow compared with every controller.
  CHECK_COMPARE(soon_N - before_N, <, 0.2 * (after_N - before_N));
  DOUBLES_EQUAL(2.0 * before_W, of(antagonist).reference, 1e-12);
  // More than the heater may have is refused, and the nearest value reported; NaN is refused too.
  for (const double wrong_W : {-0.1, 4.6, static_cast<double>(NAN)})
    CHECK(rig.answer_of(antagonist, Verb::power, wrong_W) == Refusal::out_of_range);
  DOUBLES_EQUAL(2.0 * before_W, of(antagonist).reference, 1e-12);
}

/// The limit is in watts of the agonist; the ratio of gains converts them to the antagonist's.
TEST(JointPull, RespectsTheCoContractionLimit) {
  RigSettings settings = joint_board();
  settings.firmware.joints[0].max_co_contraction_W = 1.2;
  settings.firmware.channels[antagonist].muscle.force_per_kelvin_N_per_K *= 1.25;
  settings.board.channels[antagonist].plant.force_per_kelvin_N_per_K *= 1.25;
  const double gain_ratio = settings.firmware.channels[antagonist].muscle.dc_gain_m_per_W() /
                            settings.firmware.channels[agonist].muscle.dc_gain_m_per_W();
  Rig fresh(settings);
  begin(fresh);
  CHECK_FALSE(faults_while_following(fresh, 1.0, [] { return 0.0; }));
  CHECK(fresh.answer_of(antagonist, Verb::power, 1.21 / gain_ratio) == Refusal::out_of_range);
  CHECK(fresh.answer_of(antagonist, Verb::power, 1.2 / gain_ratio) == Refusal::none);
  CHECK_FALSE(faults_while_following(fresh, 60.0, [] { return 0.0; }));
  CHECK_COMPARE(fresh.loop.channel(antagonist).snapshot().applied_W, <, 1.25 / gain_ratio);
  CHECK_COMPARE(fresh.loop.channel(antagonist).snapshot().applied_W, >, 0.9 / gain_ratio);
  // Driven by itself, the muscle may have all that its heater may.
  CHECK(fresh.answer_of(antagonist, Verb::rest) == Refusal::none);
  CHECK(fresh.answer_of(antagonist, Verb::power, 2.0) == Refusal::none);
}

/// Two muscles that are driven by themselves pull against each other with the smaller power.
TEST(JointPull, RespectsTheLimitWithMusclesDrivenSeparately) {
  RigSettings settings = joint_board();
  settings.firmware.joints[0].max_co_contraction_W = 1.2;
  const double gain_ratio = settings.firmware.channels[antagonist].muscle.dc_gain_m_per_W() /
                            settings.firmware.channels[agonist].muscle.dc_gain_m_per_W();
  const std::array<double, 2> max_W{1.2, 1.2 / gain_ratio};
  for (const std::uint8_t first : {agonist, antagonist}) {
    const std::uint8_t second = first == agonist ? antagonist : agonist;
    Rig fresh(settings);
    begin(fresh);
    CHECK(fresh.answer_of(first, Verb::power, 1.4 * max_W[first]) == Refusal::none);
    CHECK(fresh.answer_of(second, Verb::power, 1.01 * max_W[second]) == Refusal::out_of_range);
    CHECK(fresh.answer_of(second, Verb::power, max_W[second]) == Refusal::none);
    CHECK(fresh.answer_of(first, Verb::power, 1.5 * max_W[first]) == Refusal::none);
    CHECK(fresh.answer_of(first, Verb::power, 0.9 * max_W[first]) == Refusal::none);
    CHECK(fresh.answer_of(second, Verb::power, 1.5 * max_W[second]) == Refusal::none);
    CHECK(fresh.answer_of(first, Verb::power, 1.01 * max_W[first]) == Refusal::out_of_range);
  }
}

/// A commanded power may exceed the limit once the muscles are known better: here the agonist moves
/// less than was believed, so the antagonist's watts count for more.
TEST(JointPull, RespectsTheLimitAfterNewEstimates) {
  constexpr double max_W = 1.2;
  RigSettings settings = joint_board();
  settings.firmware.joints[0].max_co_contraction_W = max_W;
  control::EstimatorSettings& estimator = settings.firmware.channels[agonist].estimators[0];
  estimator.kind = control::EstimatorKind::least_squares;
  estimator.set_nominal(settings.firmware.channels[agonist].muscle, 4.5);
  Rig fresh(settings);
  begin(fresh);
  const auto gain_ratio = [&] {
    return fresh.loop.channel(antagonist).dc_gain_m_per_W() /
           fresh.loop.channel(agonist).dc_gain_m_per_W();
  };
  const double before = gain_ratio();
  // Moved until its estimates may be trusted.
  const auto trusted = [&] {
    const auto& estimate = fresh.loop.channel(agonist).estimates();
    return estimate && estimate->trusted;
  };
  for (int i = 0; i < 4000 && !trusted(); ++i) {
    const double time_s = 0.05 * i;
    const double power_W = 1.8 + 0.4 * (std::sin(0.3 * time_s) + std::sin(1.1 * time_s)) +
                           0.4 * (std::sin(3.1 * time_s) + std::sin(9.0 * time_s));
    CHECK(fresh.answer_of(agonist, Verb::power, power_W) == Refusal::none);
    fresh.run(0.05);
  }
  CHECK(fresh.answer_of(agonist, Verb::power, 1.5 * max_W) == Refusal::none);
  CHECK(fresh.answer_of(antagonist, Verb::power, max_W / before) == Refusal::none);
  CHECK(fresh.answer_of(agonist, Verb::store, 1.0) == Refusal::none);
  CHECK_COMPARE(gain_ratio(), >, 1.1 * before);
  for (int i = 0; i < 20; ++i) {
    fresh.run(0.05);
    for (const std::uint8_t channel : {agonist, antagonist})
      CHECK(fresh.answer_of(channel, Verb::renew) == Refusal::none);
  }
  const double applied_W = fresh.loop.channel(antagonist).snapshot().applied_W;
  CHECK_COMPARE(applied_W, <, 1.02 * max_W / gain_ratio());
  CHECK_COMPARE(applied_W, >, 0.9 * max_W / gain_ratio());
}

TEST(JointPull, LimitFollowsWhatIsLearnedOfTheAntagonist) {
  constexpr double max_W = 1.2;
  RigSettings settings = joint_board();
  settings.firmware.joints[0].max_co_contraction_W = max_W;
  Rig fresh(settings);
  begin(fresh);
  const auto gain_ratio = [&] {
    return fresh.loop.channel(antagonist).dc_gain_m_per_W() /
           fresh.loop.channel(agonist).dc_gain_m_per_W();
  };
  const double before = gain_ratio();
  CHECK(fresh.answer_of(antagonist, Verb::identify) == Refusal::none);
  CHECK(fresh.run_until(
      [&] {
        fresh.loop.send({antagonist, Verb::renew, 0.0});
        return fresh.loop.channel(antagonist).state().state() != State::active;
      },
      400.0));
  CHECK_COMPARE(std::abs(gain_ratio() / before - 1.0), >, 0.1);
  CHECK_FALSE(faults_while_following(fresh, 0.1, [] { return 0.0; }));
  CHECK(fresh.answer_of(antagonist, Verb::power, 1.02 * max_W / gain_ratio()) ==
        Refusal::out_of_range);
  CHECK(fresh.answer_of(antagonist, Verb::power, 0.98 * max_W / gain_ratio()) == Refusal::none);
}

TEST(JointPull, CoContractsForMinutesWithoutAFault) {
  for (const bool known : {false, true}) {
    RigSettings settings = known_joint(3.0);
    for (ChannelSettings& channel : settings.firmware.channels)
      channel.muscle_identified = known;
    Rig fresh(settings);
    begin(fresh);
    CHECK_FALSE(faults_while_following(fresh, 300.0, [] { return 0.0; }));
    CHECK_FALSE(fresh.interval_missed);
  }
}

/// The other muscle makes up for what a hot one may not give: nothing stays limited.
TEST(JointPull, ReducesCoContractionWhenOneMuscleIsDerated) {
  RigSettings settings = joint_board();
  settings.firmware.joints[0].co_contraction_W = 3.0;
  settings.firmware.channels[agonist].thermal.boot_rise_K = 20.0;  // otherwise it waits a minute
  settings.firmware.channels[agonist].limiter.derate_from_C = 50.0;
  settings.firmware.channels[agonist].limiter.derate_to_C = 90.0;
  Rig fresh(settings);
  begin(fresh);
  CHECK_FALSE(faults_while_following(fresh, 300.0, [] { return 0.0; }));
  DOUBLES_EQUAL(0.0, fresh.snapshot().position_m, 0.1e-3);
  CHECK(fresh.snapshot().limited_by == LimitedBy::nothing);
}

TEST(JointPull, StartsEachTimeWithoutCoContraction) {
  arm();
  hold(0.0, 60.0);
  CHECK_COMPARE(of(antagonist).applied_W, >, 0.5);
  CHECK(rig.answer_of(agonist, Verb::rest) == Refusal::none);
  rig.run(20.0);
  hold(0.0, 0.5);
  CHECK_COMPARE(of(antagonist).applied_W, <, 0.1);
}
