#include "loop/known_muscle.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(PublishedMuscle){};

TEST(PublishedMuscle, TellsEachQuantityAtItsPlaceAndNoOther) {
  KnownMuscle known{};
  for (std::size_t i = 0; i < known.size(); ++i)
    known[i] = 0.5 + static_cast<double>(i);
  supercoil::PublishedMuscle published;
  published.set(known);
  for (std::size_t i = 0; i < known.size(); ++i)
    DOUBLES_EQUAL(0.5 + static_cast<double>(i), published.get(i), 0.0);
  for (const std::size_t none : {known.size(), known.size() + 1, std::size_t{255}})
    CHECK(std::isnan(published.get(none)));
}

TEST(PublishedMuscle, PlacesHaveTheNamesOfTheirQuantities) {
  CHECK(known_quantities[known_cold_resistance] == "cold_resistance_Ohm");
  CHECK(known_quantities[known_position_offset] == "position_offset_m");
  CHECK(known_quantities[known_position_scale] == "position_scale");
  CHECK(known_quantities[known_response_ratio] == "response_ratio");
  CHECK(known_quantities[known_theta1_deviation] == "theta1_deviation_ratio");
  LONGS_EQUAL(14, known_unexplained_ratio);
  CHECK(known_quantities[known_unexplained_ratio] == "unexplained_ratio");
  CHECK(known_quantities[known_configured] == "configured_thermal_mass_J_per_K");
  CHECK(known_quantities[known_joint_lever - 1] == "configured_cold_resistance_Ohm");
  CHECK(known_quantities[known_joint_lever] == "joint_lever_m");
  CHECK(known_quantities.back() == "joint_other_node_offset");
  const KnownMuscle known = known_muscle(
      {}, {.position_offset_m = 0.25, .position_scale = 1.5, .cold_resistance_Ohm = 9.0}, 0.75, {},
      {{.stiffness_N_per_m = 14.0}, 8.0, {-0.015, -1.0}});
  DOUBLES_EQUAL(9.0, known[known_cold_resistance], 0.0);
  DOUBLES_EQUAL(0.25, known[known_position_offset], 0.0);
  DOUBLES_EQUAL(1.5, known[known_position_scale], 0.0);
  DOUBLES_EQUAL(0.75, known[known_response_ratio], 0.0);
  DOUBLES_EQUAL(14.0, known[known_configured + 2], 0.0);
  DOUBLES_EQUAL(8.0, known[known_joint_lever - 1], 0.0);
  DOUBLES_EQUAL(-0.015, known[known_joint_lever], 0.0);
  DOUBLES_EQUAL(-1.0, known[known_joint_other_node_offset], 0.0);
}
