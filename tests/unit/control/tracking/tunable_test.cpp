// Values of controllers and estimators that can be changed one by one.
#include "supercoil/control/tracking/tunable.hpp"

#include <array>
#include <cmath>
#include <set>

#include <CppUTest/TestHarness.h>

using namespace supercoil::control;

namespace {

ControllerSettings of_kind(ControllerKind kind) {
  ControllerSettings settings;
  settings.kind = kind;
  settings.model = wm16_model();
  return settings;
}

EstimatorSettings of_kind(EstimatorKind kind) {
  EstimatorSettings settings;
  settings.kind = kind;
  return settings;
}

using Tuning = std::array<double, tunable_count>;
template <class Settings>
Tuning tuning_of(const Settings& settings) {
  Tuning tuning;
  for (std::size_t i = 0; i < tuning.size(); ++i)
    tuning[i] = tunables()[i].get(settings);
  return tuning;
}

/// A different value within the range.
double another(const Tunable& tunable, double value) {
  if (!tunable.is_number()) return value == tunable.max ? tunable.max - 1.0 : value + 1.0;
  return value * 1.5 <= tunable.max && value > 0.0 ? value * 1.5 : tunable.max;
}

/// Returns false if these settings do not have the value.
template <class Settings>
bool changes_alone(const Settings& before, std::size_t i, std::string_view name) {
  const Tunable& tunable = tunables()[i];
  if (std::isnan(tunable.get(before))) return false;
  Settings after = before;
  const double value = another(tunable, tunable.get(before));
  tunable.set(after, value);
  Tuning expected = tuning_of(before);
  expected[i] = value;
  if (tunable.type == TunableType::pole) expected[tunable_named("reference_model")] = 0.0;
  const Tuning found = tuning_of(after);
  for (std::size_t k = 0; k < tunable_count; ++k) {
    const bool same = found[k] == expected[k] || (std::isnan(found[k]) && std::isnan(expected[k]));
    CHECK_TEXT(same, (std::string(name) + ": " + std::string(tunables()[k].name)).c_str());
  }
  return true;
}

std::size_t listed(bool (Tunable::*have)() const) {
  std::size_t count = 0;
  for (const Tunable& tunable : tunables())
    count += (tunable.*have)() ? 1 : 0;
  return count;
}

}  // namespace

TEST_GROUP(Tunables){};

TEST(Tunables, EachOfAControllerReadsBackAndChangesNoOtherValue) {
  std::set<std::size_t> seen;
  for (const auto& [name, kind] : controller_names) {
    // The law itself decides which other values exist; the model has the poles.
    const std::size_t model = tunable_named("reference_model");
    for (std::size_t i = 1; i < tunable_count; ++i) {
      if (i != model && changes_alone(of_kind(kind), i, name)) seen.insert(i);
    }
  }
  // Except for kind and reference_model, every value listed for controllers belongs to a law.
  LONGS_EQUAL(2 + seen.size(), listed(&Tunable::controllers_have));
}

TEST(Tunables, EachOfAnEstimatorReadsBackAndChangesNoOtherValue) {
  std::set<std::size_t> seen;
  for (const auto& [name, kind] : estimator_names) {
    for (std::size_t i = 1; i < tunable_count; ++i) {
      if (changes_alone(of_kind(kind), i, name)) seen.insert(i);
    }
  }
  LONGS_EQUAL(1 + seen.size(), listed(&Tunable::estimators_have));
}

TEST(Tunables, KindComesFirstForControllersAndEstimators) {
  EstimatorSettings estimator;
  tunables()[0].set(estimator, 2.0);
  CHECK(estimator.kind == EstimatorKind::least_squares);
  STRCMP_EQUAL("kind", tunables()[0].name.data());
  CHECK(tunables()[0].controllers_have() && tunables()[0].estimators_have());
  const Tunable& window = tunables()[tunable_named("window_s")];
  CHECK(std::isnan(window.get(estimator)));
  CHECK(std::isnan(tunables()[tunable_named("trusted_error")].get(of_kind(EstimatorKind::none))));
}

TEST(Tunables, OpenLoopHasOnlyItsKind) {
  const Tuning tuning = tuning_of(of_kind(ControllerKind::power));
  DOUBLES_EQUAL(0.0, tuning[0], 0.0);
  for (std::size_t i = 1; i < tunable_count; ++i)
    CHECK(std::isnan(tuning[i]));
}

TEST(Tunables, AModelIsANameOrThreePoles) {
  ControllerSettings settings = of_kind(ControllerKind::pi);
  const Tunable& model = tunables()[tunable_named("reference_model")];
  const Tunable& pole_1 = tunables()[tunable_named("model_pole_1_rad_per_s")];
  const Tunable& pole_2 = tunables()[tunable_named("model_pole_2_rad_per_s")];
  DOUBLES_EQUAL(3.0, model.get(settings), 0.0);
  DOUBLES_EQUAL(4.0, pole_1.get(settings), 0.0);
  model.set(settings, 1.0);
  CHECK(settings.model.denominator == design_model().denominator);
  CHECK(std::isnan(pole_1.get(settings)));
  model.set(settings, 0.0);
  DOUBLES_EQUAL(0.0, model.get(settings), 0.0);
  DOUBLES_EQUAL(0.8, settings.model.denominator[0], 1e-12);
  const double equal = pole_1.get(settings);
  DOUBLES_EQUAL(std::cbrt(0.8), equal, 1e-12);
  pole_1.set(settings, 3.0);
  pole_2.set(settings, 5.0);
  CHECK(settings.model.denominator == poles_model({3.0, 5.0, equal}).denominator);
  model.set(settings, 0.0);
  DOUBLES_EQUAL(5.0, pole_2.get(settings), 0.0);
}

TEST(Tunables, HaveTheirRanges) {
  const Tunable& bandwidth = tunables()[tunable_named("bandwidth_rad_per_s")];
  CHECK(bandwidth.in_range(100.0));
  CHECK_FALSE(bandwidth.in_range(100.1));
  CHECK_FALSE(bandwidth.in_range(NAN));
  const Tunable& learn = tunables()[tunable_named("learn")];
  CHECK(learn.in_range(1.0));
  CHECK_FALSE(learn.in_range(0.5));
  LONGS_EQUAL(tunable_count, tunable_named("bandwidth"));
}
