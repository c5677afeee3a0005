// Freezing, leakage, dead zone and bounds of the MRAC.
#include <limits>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/tracking/mrac.hpp"

using namespace supercoil::control;

namespace {

constexpr double fast_step_s = 1e-3;
using Law = Mrac<double>;
using Theta6 = Vector<double, 6>;

/// Inputs that excite everything: an error of about the given size and a moving reference.
LawInput<double> lively(int tick, double error_W = 0.3) {
  const double t = fast_step_s * tick;
  LawInput<double> in;
  in.reference = 2.0 + std::sin(t);
  in.model.position = 2.0 + std::sin(t - 0.5);
  in.position = in.model.position + error_W * std::sin(3.0 * t);
  in.applied = 2.0 + std::cos(t);
  return in;
}

void warm_up(Law& law) {
  for (int k = 0; k < 3000; ++k)
    law.step(lively(k));
}

}  // namespace

TEST_GROUP(MracSafeguards){};

TEST(MracSafeguards, ThetaAndSigmaAreFrozenWhileThePowerIsLimited) {
  Law law(MracSettings{}, fast_step_s);
  warm_up(law);
  const Theta6 theta = law.theta();
  const double sigma = law.sigma();
  CHECK(theta.cwiseAbs().minCoeff() > 0.0);
  CHECK(sigma != 0.0);
  for (int k = 3000; k < 5000; ++k) {
    LawInput<double> in = lively(k);
    in.limited = true;
    law.step(in);
    CHECK(law.theta() == theta);
    CHECK(law.sigma() == sigma);
  }
  law.step(lively(5000));
  CHECK(law.theta() != theta);
  CHECK(law.sigma() != sigma);
}

TEST(MracSafeguards, WithoutFreezingTheyAdaptAtTheLimitToo) {
  MracSettings settings;
  settings.freeze_when_limited = false;
  Law law(settings, fast_step_s);
  warm_up(law);
  const Theta6 theta = law.theta();
  const double sigma = law.sigma();
  LawInput<double> in = lively(3000);
  in.limited = true;
  law.step(in);
  CHECK(law.theta() != theta);
  CHECK(law.sigma() != sigma);
}

TEST(MracSafeguards, LeakagePullsThetaToItsInitialValue) {
  MracSettings settings;
  settings.initial[5] = 0.3;
  settings.sigma_modification = 0.05;
  Law law(settings, fast_step_s);
  warm_up(law);
  // Without signals the filters decay (slowest: 1 rad/s) and only the leakage is left.
  for (int k = 0; k < 40000; ++k)
    law.step({});
  const Theta6 from = law.theta() - settings.initial;
  CHECK(from.cwiseAbs().minCoeff() > 1e-12);
  for (int k = 0; k < 1000; ++k)
    law.step({});
  const Theta6 to = law.theta() - settings.initial;
  for (Eigen::Index i = 0; i < 6; ++i)
    DOUBLES_EQUAL(std::exp(-0.05 * settings.gain[i]), to[i] / from[i], 1e-3);
}

TEST(MracSafeguards, WithoutLeakageThetaStaysWhenTheSignalsEnd) {
  Law law(MracSettings{}, fast_step_s);
  warm_up(law);
  for (int k = 0; k < 40000; ++k)
    law.step({});
  const Theta6 theta = law.theta();
  for (int k = 0; k < 1000; ++k)
    law.step({});
  CHECK((law.theta() - theta).cwiseAbs().maxCoeff() < 1e-12);
}

TEST(MracSafeguards, InTheDeadZoneNothingIsLearnt) {
  MracSettings settings;
  settings.dead_zone_W = 0.01;
  Law law(settings, fast_step_s);
  for (int k = 0; k < 3000; ++k)
    law.step(lively(k, 0.009));
  CHECK(law.theta() == Theta6(settings.initial));
  CHECK(law.sigma() == 0.0);
  for (int k = 3000; k < 6000; ++k)
    law.step(lively(k, 0.1));
  CHECK(law.theta() != Theta6(settings.initial));
  CHECK(law.sigma() != 0.0);
}

TEST(MracSafeguards, ThetaNeverLeavesItsBounds) {
  MracSettings settings = MracSettings{}.scaled(10.0);
  settings.bounds = Box<double, 6>{Theta6::Constant(-0.05), Theta6::Constant(0.05)};
  Law law(settings, fast_step_s);
  bool touched = false;
  for (int k = 0; k < 6000; ++k) {
    law.step(lively(k));
    CHECK(settings.bounds->contains(law.theta()));
    touched = touched || law.theta().cwiseAbs().maxCoeff() == 0.05;
  }
  CHECK(touched);
}

TEST_GROUP(PowerRange){};

TEST(PowerRange, ClipsToItsEnds) {
  constexpr PowerRange range{0.5, 4.5};
  DOUBLES_EQUAL(0.5, range.clip(-1.0), 0.0);
  DOUBLES_EQUAL(4.5, range.clip(5.0), 0.0);
  DOUBLES_EQUAL(2.0, range.clip(2.0), 0.0);
  DOUBLES_EQUAL(4.5, range.clip(std::numeric_limits<double>::infinity()), 0.0);
  DOUBLES_EQUAL(0.5, range.clip(-std::numeric_limits<double>::infinity()), 0.0);
}

TEST(PowerRange, ClipsNaNToTheMinimum) {
  DOUBLES_EQUAL(0.5, (PowerRange{0.5, 4.5}.clip(std::numeric_limits<double>::quiet_NaN())), 0.0);
}

TEST(MracSafeguards, StartsFromScratch) {
  MracSettings settings;
  settings.initial_sigma = 0.5;
  Law law(settings, fast_step_s);
  warm_up(law);
  CHECK(law.sigma() != 0.5);
  law.start({});
  DOUBLES_EQUAL(0.5, law.sigma(), 0.0);
  CHECK(law.theta() == settings.initial);
}
