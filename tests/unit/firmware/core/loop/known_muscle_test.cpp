#include "loop/known_muscle.hpp"

#include <array>
#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(PublishedMuscle){};

TEST(PublishedMuscle, ReturnsEachQuantityAtItsPlace) {
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

TEST(PublishedMuscle, OfABoardsFileHasItsLimits) {
  ChannelSettings channel;
  channel.limiter.min_W = 0.1;
  channel.limiter.max_W = 3.5;
  channel.supervision.trip_C = 150.0;
  channel.supervision.max_travel_m = 0.03;
  const ConfiguredMuscle configured = configured_muscle(channel, -0.01);
  DOUBLES_EQUAL(3.5, configured.max_W, 0.0);
  DOUBLES_EQUAL(150.0, configured.trip_C, 0.0);
  DOUBLES_EQUAL(-0.01, configured.min_set_point_m, 0.0);
  DOUBLES_EQUAL(0.03, configured.max_set_point_m, 0.0);
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
  CHECK(known_quantities[known_configured_resistance] == "configured_cold_resistance_Ohm");
  CHECK(known_quantities[known_joint_lever] == "joint_lever_m");
  CHECK(known_quantities[known_joint_other_node_offset] == "joint_other_node_offset");
  CHECK(known_quantities[known_lever_first] == "joint_lever_first_rad");
  CHECK(known_quantities[known_lever_points] == "joint_lever_1_m");
  LONGS_EQUAL(control::Lever::max_points, known_bundle_leader_node_offset - known_lever_points);
  CHECK(known_quantities[known_min_set_point] == "min_set_point_m");
  CHECK(known_quantities[known_max_set_point] == "max_set_point_m");
  CHECK(known_quantities[known_identified] == "identified_s");
  CHECK(known_quantities[known_configured_limits] == "configured_max_W");
  CHECK(known_quantities[known_configured_bounds] == "configured_min_mass_J_per_K");
  LONGS_EQUAL(5, known_quantities.size() - known_configured_bounds);
  const KnownMuscle known = known_muscle(
      {}, {.position_offset_m = 0.25, .position_scale = 1.5, .cold_resistance_Ohm = 9.0}, 0.75, 0.0,
      {}, {{.stiffness_N_per_m = 14.0}, 8.0, {-1, control::Lever(0.015), -1.0}, {}, NAN, NAN});
  const board::Identification quality{{0.1, 0.2, 0.3, 0.4}, 1795219200.0};
  const KnownMuscle identified = known_muscle({}, {}, 0.0, 0.5, quality, {{}, 8.0, {}});
  DOUBLES_EQUAL(1795219200.0, identified[known_identified], 0.0);
  for (std::size_t i = 0; i < 5; ++i)
    DOUBLES_EQUAL(0.1 * static_cast<double>(i + 1), identified[known_theta1_deviation + i], 1e-15);
  // θ1 was kept rather than measured, and nobody identified the muscle.
  const KnownMuscle kept = known_muscle({}, {}, 0.0, 0.5, {{0.0, 0.2, 0.3, 0.4}}, {{}, 8.0, {}});
  for (const std::size_t unknown : {known_theta1_deviation, known_identified})
    CHECK(std::isnan(kept[unknown]));
  for (std::size_t i = 0; i < 5; ++i)
    CHECK(std::isnan(known[known_theta1_deviation + i]));
  DOUBLES_EQUAL(9.0, known[known_cold_resistance], 0.0);
  DOUBLES_EQUAL(0.25, known[known_position_offset], 0.0);
  DOUBLES_EQUAL(1.5, known[known_position_scale], 0.0);
  DOUBLES_EQUAL(0.75, known[known_response_ratio], 0.0);
  DOUBLES_EQUAL(14.0, known[known_configured + 2], 0.0);
  DOUBLES_EQUAL(8.0, known[known_configured_resistance], 0.0);
  DOUBLES_EQUAL(-0.015, known[known_joint_lever], 0.0);
  DOUBLES_EQUAL(-1.0, known[known_joint_other_node_offset], 0.0);
  CHECK(known_quantities[known_bundle_leader_node_offset] == "bundle_leader_node_offset");
  CHECK(std::isnan(known[known_bundle_leader_node_offset]));
  const KnownMuscle third = known_muscle({}, {}, 0.0, 0.0, {}, {{}, 8.0, {}, {true, -2.0}});
  DOUBLES_EQUAL(-2.0, third[known_bundle_leader_node_offset], 0.0);
  const KnownMuscle ranged = known_muscle({}, {}, 0.0, 0.0, {}, {{}, 8.0, {}, {}, -0.005, 0.02});
  DOUBLES_EQUAL(-0.005, ranged[known_min_set_point], 0.0);
  DOUBLES_EQUAL(0.02, ranged[known_max_set_point], 0.0);
  const KnownMuscle bounded = known_muscle({}, {}, 0.0, 0.0, {},
                                           {{},
                                            8.0,
                                            {},
                                            {},
                                            NAN,
                                            NAN,
                                            4.5,
                                            140.0,
                                            {.min_mass_J_per_K = 0.1,
                                             .max_mass_J_per_K = 0.2,
                                             .min_transfer_W_per_K = 0.3,
                                             .max_transfer_W_per_K = 0.4,
                                             .max_time_constant_s = 0.5}});
  DOUBLES_EQUAL(4.5, bounded[known_configured_limits], 0.0);
  DOUBLES_EQUAL(140.0, bounded[known_configured_limits + 1], 0.0);
  for (std::size_t i = 0; i < 5; ++i)
    DOUBLES_EQUAL(0.1 * static_cast<double>(i + 1), bounded[known_configured_bounds + i], 1e-15);
}

namespace {

KnownMuscle known_in(const PlaceInJoint& joint) {
  return known_muscle({}, {}, 0.0, 0.0, {}, {{}, 8.0, joint});
}

}  // namespace

TEST_GROUP(PublishedJoint){};

TEST(PublishedJoint, MatchesTheJointOfItsBoard) {
  const std::array<double, 3> radii_m{0.010, 0.014, 0.008};
  for (const control::Lever& lever : {control::Lever(0.02), control::Lever(-0.5, 0.25, radii_m)}) {
    for (const int direction : {1, -1}) {
      const PlaceInJoint published = joint_from(known_in({direction, lever, 2.0}));
      LONGS_EQUAL(direction, published.direction);
      DOUBLES_EQUAL(2.0, published.other_channel_offset, 0.0);
      for (const double angle_rad : {-1.0, -0.2, 0.0, 0.1, 2.0})
        DOUBLES_EQUAL(direction * lever.arc_m(angle_rad), published.position_m(angle_rad), 1e-15);
    }
  }
  LONGS_EQUAL(0, joint_from(known_in({})).direction);
}

TEST(PublishedJoint, AnInvalidTableIsIgnored) {
  const std::array<double, 3> radii_m{0.010, 0.014, 0.008};
  const KnownMuscle right = known_in({1, control::Lever(-0.5, 0.5, radii_m), 1.0});
  CHECK_FALSE(joint_from(right).lever.is_constant());
  const auto with = [&right](std::size_t place, double value) {
    KnownMuscle wrong = right;
    wrong[place] = value;
    return joint_from(wrong);
  };
  for (const double wrong : {static_cast<double>(NAN), 0.1, static_cast<double>(-INFINITY)})
    CHECK(with(known_lever_first, wrong).lever == control::Lever(0.014));
  for (const double wrong : {static_cast<double>(NAN), -0.5, static_cast<double>(INFINITY)})
    CHECK(with(known_lever_last, wrong).lever == control::Lever(0.014));
  for (const double wrong : {static_cast<double>(NAN), -0.01, 0.0})
    CHECK(with(known_lever_points + 1, wrong).lever == control::Lever(0.014));
  for (const double wrong : {static_cast<double>(NAN), 0.0})
    LONGS_EQUAL(0, with(known_joint_lever, wrong).direction);
}
