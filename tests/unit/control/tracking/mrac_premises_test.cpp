#include "supercoil/control/tracking/mrac_premises.hpp"

#include <limits>
#include <set>
#include <string>

#include <CppUTest/TestHarness.h>

using namespace supercoil::control;

namespace {

enum Premise : std::size_t { lambda, poles, gains, model, realness, factors };
using Failing = std::set<std::size_t>;

/// The premises that are named as failing; also checks that hold() agrees.
Failing failing(const MracSettings& settings, const ReferenceModelSettings& m = wm16_model()) {
  const MracPremises premises = check_premises(settings, m);
  Failing result;
  const auto failures = premises.failures();
  for (std::size_t i = 0; i < failures.size(); ++i) {
    if (failures[i] != nullptr) result.insert(i);
  }
  CHECK(premises.hold() == result.empty());
  return result;
}

template <class Change>
MracSettings changed(Change change) {
  MracSettings settings;
  change(settings);
  return settings;
}

}  // namespace

TEST_GROUP(MracPremises){};

TEST(MracPremises, AllHoldForThePapersConstantsWithWm16) {
  CHECK(failing(MracSettings{}).empty());
  CHECK(failing(*mrac_preset("a")).empty());
}

TEST(MracPremises, Eq8AndTheDesignAreNotStrictlyPositiveRealWithThePapersPoles) {
  CHECK((failing(MracSettings{}, eq8_model()) == Failing{realness, factors}));
  CHECK((failing(MracSettings{}, design_model()) == Failing{realness, factors}));
}

TEST(MracPremises, AnUnstableLambdaFailsAlone) {
  for (const Polynomial<2>& bad :
       {Polynomial<2>{2.0, -3.0, 1.0}, {0.0, 3.0, 1.0}, {std::nan(""), 3.0, 1.0}}) {
    CHECK((failing(changed([&](auto& s) { s.lambda = bad; })) == Failing{lambda}));
  }
}

TEST(MracPremises, EachInvalidGainFailsAlone) {
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (const double bad : {0.0, -1.0, std::nan("")})
      CHECK((failing(changed([&](auto& s) { s.gain[i] = bad; })) == Failing{gains}));
  }
  for (const double bad : {-1e-9, std::nan("")}) {
    CHECK((failing(changed([&](auto& s) { s.sigma_gain = bad; })) == Failing{gains}));
    CHECK((failing(changed([&](auto& s) { s.damping = bad; })) == Failing{gains}));
  }
  CHECK(failing(changed([](auto& s) { s.sigma_gain = s.damping = 0.0; })).empty());
}

TEST(MracPremises, AModelWithAnotherPoleFailsOnlyItsFactors) {
  CHECK((failing(MracSettings{}, poles_model({4.0, 5.0, 0.9})) == Failing{factors}));
  CHECK((failing(changed([](auto& s) { s.q0_rad_per_s = 0.9; })) == Failing{factors}));
}

TEST(MracPremises, ANonPositivePoleFailsAsPolesAndFactors) {
  // The factors fail as well; with p0 and p1 so does positive realness.
  for (const double bad : {0.0, -0.8, std::nan("")}) {
    CHECK((failing(changed([&](auto& s) { s.q0_rad_per_s = bad; })) == Failing{poles, factors}));
    CHECK(failing(changed([&](auto& s) { s.p0_rad_per_s = bad; })).contains(poles));
    CHECK(failing(changed([&](auto& s) { s.p1_rad_per_s = bad; })).contains(poles));
  }
}

TEST(MracPremises, AnUnstableOrNegativeModelIsNamed) {
  // It cannot be strictly positive real either.
  ReferenceModelSettings unstable = wm16_model();
  unstable.denominator[1] *= -1.0;
  CHECK((failing(MracSettings{}, unstable) == Failing{model, realness, factors}));
  ReferenceModelSettings negative = wm16_model();
  negative.gain *= -1.0;
  CHECK((failing(MracSettings{}, negative) == Failing{model, realness}));
  negative.gain = std::nan("");
  CHECK(failing(MracSettings{}, negative).contains(model));
}

TEST(MracPremises, EachFailureHasItsOwnMessage) {
  MracPremises none{};
  std::set<std::string> words;
  for (const char* failure : none.failures())
    words.insert(failure);
  LONGS_EQUAL(MracPremises::count, words.size());
  STRCMP_CONTAINS("lambda", none.failures()[lambda]);
  STRCMP_CONTAINS("p0, p1 and q0", none.failures()[poles]);
  STRCMP_CONTAINS("gain", none.failures()[gains]);
  STRCMP_CONTAINS("model is not stable", none.failures()[model]);
  STRCMP_CONTAINS("positive real", none.failures()[realness]);
  STRCMP_CONTAINS("Eq. (12)", none.failures()[factors]);
}
