#include "apps/supercoil/setup/describe_muscle.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <CppUTest/TestHarness.h>

using namespace supercoil::operating;

namespace {

/// What a bench would answer for the paper's muscle.
MuscleAnswers paper_answers() {
  MuscleAnswers a;
  const auto set = [&](QuestionId what, double value) {
    a.set(static_cast<std::size_t>(what), value);
  };
  set(QuestionId::cold_resistance_Ohm, 10.0);
  set(QuestionId::load_g, 90.0);
  set(QuestionId::stretch_weight_g, 100.0);
  set(QuestionId::stretch_mm, 61.3125);
  set(QuestionId::heated_W, 2.0);
  set(QuestionId::heated_mm, 12.0787);
  set(QuestionId::half_cooling_s, 1.26168);
  set(QuestionId::thread_g, 0.162 / 1.65);
  set(QuestionId::heated_K, 0.0);
  set(QuestionId::max_W, 4.5);
  set(QuestionId::max_travel_mm, 25.0);
  set(QuestionId::uncertainty_percent, 50.0);
  return a;
}

std::string literal_of(const MuscleDescription& description, const std::string& path) {
  const auto found = std::ranges::find(description.entries, path, &Entry::path);
  CHECK(found != description.entries.end());
  return found->literal;
}

double bound(const MuscleDescription& description, const std::string& key) {
  return std::stod(literal_of(description, "thermal." + key));
}

}  // namespace

TEST_GROUP(DescribeMuscle){};

TEST(DescribeMuscle, ConvertsBenchUnitsToMuscleParameters) {
  const auto d = describe_muscle(paper_answers());
  CHECK_TRUE(d.has_value());
  DOUBLES_EQUAL(0.162, d->muscle.thermal_mass_J_per_K, 1e-6);
  DOUBLES_EQUAL(0.089, d->muscle.heat_transfer_W_per_K, 1e-5);
  DOUBLES_EQUAL(16.0, d->muscle.stiffness_N_per_m, 1e-6);
  DOUBLES_EQUAL(0.09, d->muscle.moving_mass_kg, 1e-12);
  DOUBLES_EQUAL(0.0086, d->muscle.force_per_kelvin_N_per_K, 1e-6);
  STRCMP_EQUAL("4.5", literal_of(*d, "limits.max_W").c_str());
  STRCMP_EQUAL("0.025", literal_of(*d, "limits.max_travel_m").c_str());
  STRCMP_EQUAL("10", literal_of(*d, "heater.cold_resistance_Ohm").c_str());
}

TEST(DescribeMuscle, BoundsCoverErrorsOfAllAnswers) {
  const auto d = describe_muscle(paper_answers());
  // Each answer is 0.5 to 1.5 times the truth; the heat transfer follows from two answers.
  DOUBLES_EQUAL(0.162 / 1.5, bound(*d, "min_mass_J_per_K"), 1e-4);
  DOUBLES_EQUAL(0.162 / 0.5, bound(*d, "max_mass_J_per_K"), 1e-4);
  DOUBLES_EQUAL(0.089 * 0.5 / 1.5, bound(*d, "min_transfer_W_per_K"), 1e-5);
  DOUBLES_EQUAL(0.089 * 1.5 / 0.5, bound(*d, "max_transfer_W_per_K"), 1e-4);
  DOUBLES_EQUAL(0.5, bound(*d, "weighed_mass_error_ratio"), 0.0);
  // The time in which the muscle cools by half is one answer; it gives mass over heat transfer.
  DOUBLES_EQUAL(1.25 * 0.162 / 0.089 / 0.5, bound(*d, "max_time_constant_s"), 0.01);
}

TEST(DescribeMuscle, ATemperatureReplacesTheThreadsWeight) {
  MuscleAnswers a = paper_answers();
  a.set(static_cast<std::size_t>(QuestionId::thread_g), 0.0);
  a.set(static_cast<std::size_t>(QuestionId::heated_K), 2.0 / 0.089);
  const auto d = describe_muscle(a);
  DOUBLES_EQUAL(0.089, d->muscle.heat_transfer_W_per_K, 1e-6);
  DOUBLES_EQUAL(0.162, d->muscle.thermal_mass_J_per_K, 1e-4);
  CHECK(std::ranges::find(d->entries, "thermal.weighed_mass_J_per_K", &Entry::path) ==
        d->entries.end());
  DOUBLES_EQUAL(0.089 * 0.5 / 1.5, bound(*d, "min_transfer_W_per_K"), 1e-5);
  DOUBLES_EQUAL(0.162 * 0.5 / (1.5 * 1.5), bound(*d, "min_mass_J_per_K"), 1e-4);
}

TEST(DescribeMuscle, RequiresTheThreadsWeightOrATemperature) {
  MuscleAnswers a = paper_answers();
  a.set(static_cast<std::size_t>(QuestionId::thread_g), 0.0);
  const auto d = describe_muscle(a);
  CHECK_FALSE(d.has_value());
  STRCMP_CONTAINS("thread_g or heated_K", d.error().text().c_str());
}

TEST(DescribeMuscle, ImplausibleAnswersAreNamed) {
  MuscleAnswers a = paper_answers();
  a.set(static_cast<std::size_t>(QuestionId::stretch_weight_g), 1e6);
  a.set(static_cast<std::size_t>(QuestionId::stretch_mm), 0.01);
  const auto d = describe_muscle(a);
  CHECK_FALSE(d.has_value());
  STRCMP_EQUAL(
      "stretch_weight_g and stretch_mm give a muscle with stiffness_N_per_m = 9.81e+08; it must be "
      "0.01 to 1e+06",
      d.error().text().c_str());
}

/// By its weight the paper's muscle is 22.5 K warmer at 2 W. The answers may be wrong by half.
TEST(DescribeMuscle, AThermometerThatContradictsTheWeightIsNamed) {
  for (const auto& [heated_K, agrees] : {std::pair{22.5, true}, std::pair{60.0, true},
                                         std::pair{2.0, false}, std::pair{8.0, true}}) {
    MuscleAnswers a = paper_answers();
    a.set(static_cast<std::size_t>(QuestionId::heated_K), heated_K);
    CHECK_EQUAL(agrees, describe_muscle(a).has_value());
  }
  MuscleAnswers a = paper_answers();
  a.set(static_cast<std::size_t>(QuestionId::heated_K), 150.0);
  a.set(static_cast<std::size_t>(QuestionId::uncertainty_percent), 20.0);
  STRCMP_EQUAL(
      "thread_g and heated_K contradict each other: by its weight and half_cooling_s the thread is "
      "12.5 K to 42.1 K warmer than the air at heated_W, not 150 K",
      describe_muscle(a).error().text().c_str());
}

/// Ten watts in a hundredth of a gram that cools as slowly.
TEST(DescribeMuscle, AHeatThatTheThreadWouldNotEndureIsNamed) {
  MuscleAnswers a = paper_answers();
  a.set(static_cast<std::size_t>(QuestionId::heated_W), 10.0);
  a.set(static_cast<std::size_t>(QuestionId::thread_g), 0.01);
  STRCMP_CONTAINS("heated_W and thread_g contradict each other: by its weight",
                  describe_muscle(a).error().text().c_str());
}

TEST(DescribeMuscle, APowerStageWithDelayGetsLessBandwidth) {
  const auto bandwidth_with = [](double delay_s) {
    const std::string law =
        literal_of(*describe_muscle(paper_answers(), {1e-3, delay_s}), "controller");
    const std::string key = "bandwidth_rad_per_s = ";
    return std::stod(law.substr(law.find(key) + key.size()));
  };
  DOUBLES_EQUAL(8.0, bandwidth_with(1e-3), 1e-3);
  CHECK(bandwidth_with(0.1) < 5.0);
}
