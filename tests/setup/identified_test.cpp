// What identify reports about the muscle that it found: how certain each parameter is, and whether
// it is within the file's bounds.
#include "apps/supercoil/setup/identified.hpp"

#include <array>
#include <cmath>
#include <random>
#include <string>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "supercoil/control/actuator/conversions.hpp"

#include "apps/supercoil/identified_deviations.hpp"
#include "setup/commissioned.hpp"
#include "setup/listener.hpp"

using namespace supercoil;
using namespace supercoil::test;
using control::PhysicalParameters;

namespace {

using Values = operating::IdentifiedValues;
using operating::identified_deviations;
using operating::identified_values;
using operating::named_deviations;

/// From many muscles with random errors of theta. scaled: theta1 follows theta3.
Values drawn(const PhysicalParameters& muscle, const std::array<double, 4>& ratios, bool scaled) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const control::Theta theta = control::theta_from(muscle);
  Values squares{};
  constexpr int draws = 4000;
  for (int draw = 0; draw < draws; ++draw) {
    control::Theta off = theta;
    for (int i = 0; i < 4; ++i)
      off[i] *= 1.0 + ratios[static_cast<std::size_t>(i)] * normal(random);
    if (scaled) off[0] = theta[0] * off[2] / theta[2];
    const auto found =
        control::physical_from(off, {muscle.force_per_kelvin_N_per_K, muscle.moving_mass_kg});
    CHECK_TRUE(found.has_value());
    for (std::size_t k = 0; k < squares.size(); ++k)
      squares[k] += std::pow(identified_values(*found)[k] / identified_values(muscle)[k] - 1.0, 2);
  }
  for (double& square : squares)
    square = std::sqrt(square / draws);
  return squares;
}

KnownMuscle known_of(const PhysicalParameters& muscle) {
  KnownMuscle known{};
  for (std::size_t i = 0; i < control::physical_ranges.size(); ++i)
    known[i] = muscle.*control::physical_ranges[i].member;
  for (std::size_t i = 0; i < 4; ++i)
    known[known_theta1_deviation + i] = 0.01;
  known[known_unexplained_ratio] = 0.002;
  return known;
}

}  // namespace

TEST_GROUP(Identified){};

TEST(Identified, DeviationsMatchAMonteCarloSample) {
  const PhysicalParameters muscle;
  const std::array<double, 4> ratios{0.004, 0.01, 0.003, 0.005};
  for (const bool scaled : {false, true}) {
    std::array<double, 4> theta_deviations = ratios;
    if (scaled) theta_deviations[0] = NAN;
    const auto by_slopes = identified_deviations(muscle, theta_deviations);
    const Values by_draws = drawn(muscle, ratios, scaled);
    DOUBLES_EQUAL(1.0, by_slopes.time_constant / by_draws[4], 0.06);
    DOUBLES_EQUAL(1.0, by_slopes.gain / by_draws[5], 0.06);
    for (std::size_t k = 0; k < by_slopes.parameters.size(); ++k) {
      // Where theta1 is kept as believed, so is each of them.
      if (scaled) CHECK_TRUE(std::isnan(by_slopes.parameters[k]));
      if (!scaled) DOUBLES_EQUAL(1.0, by_slopes.parameters[k] / by_draws[k], 0.06);
    }
  }
}

TEST(Identified, ShowsValuesWithDeviationsAndTheConfiguredValues) {
  ChannelSettings configured;
  PhysicalParameters muscle = configured.muscle;
  muscle.stiffness_N_per_m *= 1.1;
  Listener listener;
  const auto found = operating::report_identified(known_of(muscle), configured, listener);
  const std::string output = listener.take();
  STRCMP_CONTAINS("stiffness_N_per_m: 17.6 ± ", output.c_str());
  STRCMP_CONTAINS(" % (configured: 16, +10 %)\n", output.c_str());
  STRCMP_CONTAINS("unexplained by the linear model: 0.2 %\n", output.c_str());
  CHECK_TRUE(output.find("theta") == std::string::npos);
  CHECK(found["stiffness_N_per_m_deviation_ratio"].get<double>() > 0.001);
  CHECK_TRUE(!found.contains("moving_mass_kg_deviation_ratio"));
  DOUBLES_EQUAL(0.01, found["theta4_deviation_ratio"].get<double>(), 0.0);
  for (const auto& [name, ratio] : named_deviations(identified_deviations(known_of(muscle))))
    DOUBLES_EQUAL(ratio, found[name].get<double>(), 0.0);

  STRCMP_CONTAINS("gain: 5.49 mm/W ± 1 % (configured: 6.039, -9.09 %)\n", output.c_str());
  STRCMP_CONTAINS("time constant: 1.82 s ± ", output.c_str());

  KnownMuscle kept = known_of(muscle);
  kept[known_theta1_deviation] = NAN;
  operating::report_identified(kept, configured, listener);
  const std::string of_kept = listener.take();
  STRCMP_CONTAINS("stiffness_N_per_m: 17.6 (configured: 16, +10 %)\n", of_kept.c_str());
  STRCMP_CONTAINS("theta1 was kept: each of these depends on the file's values", of_kept.c_str());
  STRCMP_CONTAINS("gain: 5.49 mm/W ± 1 % ", of_kept.c_str());

  // A muscle that was stored before deviations were stored.
  KnownMuscle known = known_of(muscle);
  for (std::size_t i = 0; i < 4; ++i)
    known[known_theta1_deviation + i] = NAN;
  const auto later = operating::report_identified(known, configured, listener);
  const std::string output_later = listener.take();
  STRCMP_CONTAINS("stiffness_N_per_m: 17.6 (configured: 16, +10 %)\n", output_later.c_str());
  STRCMP_CONTAINS("gain: 5.49 mm/W (configured: ", output_later.c_str());
  CHECK_TRUE(output_later.find("theta1") == std::string::npos);
  CHECK_TRUE(later["stiffness_N_per_m_deviation_ratio"].is_null());
}

TEST(Identified, WarnsOfAResultOutsideTheConfiguredBounds) {
  ChannelSettings configured;
  configured.thermal.bounds = {0.1, 0.2, 0.05, 0.12};
  PhysicalParameters muscle = configured.muscle;
  Listener listener;
  operating::report_identified(known_of(muscle), configured, listener);
  CHECK_TRUE(listener.take().find("warning") == std::string::npos);
  muscle.heat_transfer_W_per_K = 0.13;
  operating::report_identified(known_of(muscle), configured, listener);
  STRCMP_CONTAINS(
      "warning: heat_transfer_W_per_K = 0.13 lies outside thermal.min_transfer_W_per_K to "
      "max_transfer_W_per_K, 0.05 to 0.12: ",
      listener.take().c_str());
}

TEST(Identified, ReportsWhatTheBoardIdentified) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  Listener listener;
  operating::Commission steps = board.steps(listener);
  CHECK(steps.calibrate().has_value());
  const auto found = steps.identify();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  STRCMP_CONTAINS(" ± ", listener.take().c_str());
  for (const char* name : {"time_constant", "gain"}) {
    const double ratio = (*found)[std::string(name) + "_deviation_ratio"];
    CHECK(ratio > 0.0);
    CHECK(ratio < 0.1);
  }
}
