#include "apps/supercoil/setup/file_joint.hpp"

#include <string>

#include <CppUTest/TestHarness.h>

#include "apps/supercoil/setup/channel_steps.hpp"

using namespace supercoil::operating;

namespace {

const std::string alone = "[[channel]]\nname = \"alone\"\n";
const std::string by_channels =
    "[[joint]]\nagonist = 4\nantagonist = 5\nlever_m = 0.02\n"
    "[[joint]]\nagonist = 1\nantagonist = 2\nlever_m = 0.015\n";
const std::string by_range = by_channels + "range_deg = [-20, 30]\n";

std::string travel(const std::string& text, int channel, double travel_m) {
  const auto entry = travel_entry(text, channel, travel_m, "literal", "reason");
  return entry ? entry->key() + " = " + entry->literal : "";
}

}  // namespace

TEST_GROUP(FileJoint){};

TEST(FileJoint, TravelIsALimitOfTheChannelUnlessTheJointHasARange) {
  for (const std::string& text : {alone, by_channels})
    STRCMP_EQUAL("limits.max_travel_m = literal", travel(text, 1, 0.005).c_str());
  STRCMP_EQUAL("limits.max_travel_m = literal", travel(by_range, 4, 0.005).c_str());
}

TEST(FileJoint, AMusclesSideOfTheRangeOnlyShrinks) {
  // 5 mm at 15 mm are 19.0986 degrees.
  STRCMP_EQUAL("joint.range_deg = [-20, 19.09]", travel(by_range, 1, 0.005).c_str());
  STRCMP_EQUAL("joint.range_deg = [-19.09, 30]", travel(by_range, 2, 0.005).c_str());
  LONGS_EQUAL(1, *travel_entry(by_range, 2, 0.005, "", "")->joint);
  STRCMP_EQUAL("", travel(by_range, 2, 0.006).c_str());
  STRCMP_EQUAL("joint.range_deg = [-20, 22.91]", travel(by_range, 1, 0.006).c_str());
  STRCMP_EQUAL("", travel(by_range, 1, 0.008).c_str());
}

TEST(FileJoint, TheRangeOfAOneMuscleJointKeepsItsStart) {
  const std::string finger =
      "[[joint]]\nopposed_by = \"spring\"\nagonist = 1\nlever_m = 0.015\nrange_deg = [0, 30]\n";
  STRCMP_EQUAL("joint.range_deg = [0, 19.09]", travel(finger, 1, 0.005).c_str());
  STRCMP_EQUAL("", travel(finger, 1, 0.008).c_str());
}

TEST(FileJoint, IsFoundWithItsLeverByEitherMuscle) {
  CHECK_FALSE(joint_in_file(alone, 1).has_value());
  CHECK_FALSE(joint_in_file(by_range, 3).has_value());
  const auto second = joint_in_file(by_range, 2);
  CHECK_FALSE(second->agonist);
  LONGS_EQUAL(1, second->place);
  DOUBLES_EQUAL(0.015, second->lever.zero_radius_m(), 1e-12);
  DOUBLES_EQUAL(0.015 * 20.0 / 57.29578, second->max_travel_m(), 1e-8);
  CHECK_FALSE(joint_in_file(by_channels, 1)->range_deg.has_value());
}
