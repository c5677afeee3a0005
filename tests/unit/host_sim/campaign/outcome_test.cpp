// The quantities by which a run of a study is judged.
#include "campaign/outcome.hpp"

#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "runner/simulation.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil::host_sim;
using namespace supercoil::host_sim::campaign;
using supercoil::test::read;

namespace {

double quantity_of(const std::string& text, const char* name) {
  const std::atomic<bool> stop = false;
  const Scenario scenario = read(text);
  const auto outcome = simulate(scenario, Window{}, stop);
  return outcome->values.at(*find_quantity(name));
}

/// The highest rise above the air of each muscle of a joint or a bundle.
std::array<double, 2> rises_K(const std::string& text) {
  const Scenario scenario = read(text);
  Simulation simulation(scenario);
  std::array<double, 2> max_K{};
  while (!simulation.done()) {
    const TickRecord& r = simulation.step();
    max_K[0] = std::max(max_K[0], r.temperature_rise_K);
    max_K[1] = std::max(max_K[1], r.antagonist ? r.antagonist->temperature_rise_K
                                               : r.bundle->max_temperature_rise_K);
  }
  return max_K;
}

const std::string identified =
    "simulation = {duration_s = 100.0, rate_Hz = 100.0}\noperator.action = 'identify'\n";

}  // namespace

TEST_GROUP(Outcome){};

TEST(Outcome, TheHottestMuscleOfAJointCounts) {
  const std::string text =
      "simulation.duration_s = 20.0\nambient.air_C = 25.0\n[joint]\n"
      "[reference]\nkind = 'steps'\nlevels_m = [-0.005]\n";
  const auto [agonist_K, antagonist_K] = rises_K(text);
  CHECK_COMPARE(antagonist_K, >, agonist_K + 5.0);
  DOUBLES_EQUAL(antagonist_K, quantity_of(text, "hottest_rise_K"), 0.0);
  DOUBLES_EQUAL(25.0 + antagonist_K, quantity_of(text, "hottest_C"), 1e-9);
}

TEST(Outcome, TheHottestMuscleOfABundleCounts) {
  const std::string text =
      "simulation.duration_s = 20.0\n[bundle]\nmuscles = 2\n"
      "[bundle.2]\nheat_transfer_W_per_K = 0.05\n";
  const auto [first_K, hottest_K] = rises_K(text);
  CHECK_COMPARE(hottest_K, >, first_K + 5.0);
  DOUBLES_EQUAL(hottest_K, quantity_of(text, "hottest_rise_K"), 0.0);
}

TEST(Outcome, IdentifyIsComparedWithTheMuscleOfThatTime) {
  CHECK_COMPARE(quantity_of(identified, "gain_error_ratio"), <, 0.05);
  CHECK_COMPARE(quantity_of(identified + "[[event]]\nat_s = 95.0\nplant.stiffness_N_per_m = 8.0\n"
                                         "operator.action = 'rest'\n",
                            "gain_error_ratio"),
                <, 0.05);
}

TEST(Outcome, WhatIdentifyFindsOfAJointOrABundleIsNotComparedWithOneMuscle) {
  for (const char* several : {"[joint]\n", "[bundle]\nmuscles = 2\n"}) {
    DOUBLES_EQUAL(0.0, quantity_of(identified + several, "not_found"), 0.0);
    CHECK(std::isnan(quantity_of(identified + several, "gain_error_ratio")));
    CHECK(std::isnan(quantity_of(identified + several, "cooling_error_ratio")));
  }
}
