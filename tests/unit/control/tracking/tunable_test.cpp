// The values of a controller that can be changed one by one.
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

using Tuning = std::array<double, tunable_count>;
Tuning tuning_of(const ControllerSettings& settings) {
  Tuning tuning;
  for (std::size_t i = 0; i < tuning.size(); ++i)
    tuning[i] = tunables()[i].get(settings);
  return tuning;
}

/// In range, and another one.
double another(const Tunable& tunable, double value) {
  if (tunable.type != TunableType::number && tunable.type != TunableType::pole)
    return value == tunable.highest ? tunable.highest - 1.0 : value + 1.0;
  return value * 1.5 <= tunable.highest && value > 0.0 ? value * 1.5 : tunable.highest;
}

}  // namespace

TEST_GROUP(Tunables){};

TEST(Tunables, EachIsReadBackAndChangesNoOtherValue) {
  std::set<std::size_t> seen;
  for (const auto& [name, kind] : controller_names) {
    // The law itself decides which others there are, and the model has the poles.
    for (std::size_t i = 1; i < tunable_count; ++i) {
      const Tunable& tunable = tunables()[i];
      const ControllerSettings before = of_kind(kind);
      if (tunable.type == TunableType::model || std::isnan(tunable.get(before))) continue;
      seen.insert(i);
      ControllerSettings after = before;
      const double value = another(tunable, tunable.get(before));
      tunable.set(after, value);
      Tuning expected = tuning_of(before);
      expected[i] = value;
      if (tunable.type == TunableType::pole) expected[tunable_named("reference_model")] = 0.0;
      const Tuning found = tuning_of(after);
      for (std::size_t k = 0; k < tunable_count; ++k) {
        const bool same =
            found[k] == expected[k] || (std::isnan(found[k]) && std::isnan(expected[k]));
        CHECK_TEXT(same, (std::string(name) + ": " + std::string(tunables()[k].name)).c_str());
      }
    }
  }
  // But kind and reference_model: every name belongs to some law.
  LONGS_EQUAL(tunable_count - 2, seen.size());
}

TEST(Tunables, OpenLoopHasItsKindOnly) {
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
