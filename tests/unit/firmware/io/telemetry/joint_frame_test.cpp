// What Joint reports, read by the codec that cantools generated.
#include "telemetry/joint_frame.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <supercoil.h>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/can/support/unpacked.hpp"

using namespace supercoil;
using namespace supercoil::telemetry;
using supercoil::test::unpacked;

namespace {

constexpr double lever_m = 0.015;
constexpr int angle_not_available = -524288;

/// With a lever of 15 mm.
float at_deg(double angle_deg) {
  return static_cast<float>(lever_m * angle_deg * 3.14159265358979 / 180.0);
}

Row agonist_row() {
  Row row{};
  row.mode = static_cast<std::uint8_t>(Mode::position);
  row.flags = row_limited;
  row.position_m = at_deg(-12.3455);
  row.reference = at_deg(20.0);
  row.model_m = at_deg(-12.0);
  row.demanded_W = -1.234F;
  row.applied_W = 0.125F;
  row.resistance_Ohm = 5.432F;
  row.coldest_C = 31.25F;
  row.hottest_C = 42.5F;
  return row;
}

Row antagonist_row() {
  Row row{};
  row.mode = static_cast<std::uint8_t>(Mode::joint);
  row.flags = row_slack;
  row.demanded_W = 0.9F;
  row.applied_W = 1.5F;
  row.resistance_Ohm = 6.0F;
  row.coldest_C = 50.0F;
  row.hottest_C = 61.0F;
  return row;
}

supercoil_joint_t sent(JointPart part, const Row& agonist, const Row* antagonist,
                       const control::Lever& lever = control::Lever(lever_m)) {
  return unpacked(joint(1, part, lever, agonist, antagonist), supercoil_joint_unpack);
}

}  // namespace

TEST_GROUP(JointFrame) {
  Row agonist = agonist_row();
  Row antagonist = antagonist_row();
};

TEST(JointFrame, EveryPartHasTheAngleAndTheLimitOfEachMuscle) {
  for (std::uint8_t part = 0; part < joint_parts(true); ++part) {
    const auto m = sent(static_cast<JointPart>(part), agonist, &antagonist);
    LONGS_EQUAL(part, m.part);
    DOUBLES_EQUAL(-12.3455, supercoil_joint_angle_deg_decode(m.angle_deg), 0.00026);
    LONGS_EQUAL(1, m.agonist_limited);
    LONGS_EQUAL(0, m.agonist_slack);
    LONGS_EQUAL(0, m.antagonist_limited);
    LONGS_EQUAL(1, m.antagonist_slack);
  }
}

TEST(JointFrame, MotionAndEffortAreOfTheJoint) {
  const auto motion = sent(JointPart::motion, agonist, &antagonist);
  DOUBLES_EQUAL(20.0, supercoil_joint_reference_deg_decode(motion.reference_deg), 0.00026);
  DOUBLES_EQUAL(-0.3455, supercoil_joint_error_deg_decode(motion.error_deg), 0.00026);
  const auto effort = sent(JointPart::effort, agonist, &antagonist);
  DOUBLES_EQUAL(-1.234, supercoil_joint_effort_w_decode(effort.effort_w), 1e-9);
  DOUBLES_EQUAL(0.9, supercoil_joint_co_contraction_w_decode(effort.co_contraction_w), 1e-9);
}

TEST(JointFrame, HeatAndPowerAreOfTheNamedMuscle) {
  const auto heat = sent(JointPart::agonist_heat, agonist, &antagonist);
  DOUBLES_EQUAL(31.25, supercoil_joint_agonist_coldest_c_decode(heat.agonist_coldest_c), 1e-9);
  DOUBLES_EQUAL(42.5, supercoil_joint_agonist_hottest_c_decode(heat.agonist_hottest_c), 1e-9);
  const auto power = sent(JointPart::agonist_power, agonist, &antagonist);
  DOUBLES_EQUAL(0.125, supercoil_joint_agonist_applied_w_decode(power.agonist_applied_w), 1e-9);
  DOUBLES_EQUAL(5.43, supercoil_joint_agonist_resistance_ohm_decode(power.agonist_resistance_ohm),
                1e-9);
  const auto other = sent(JointPart::antagonist_heat, agonist, &antagonist);
  DOUBLES_EQUAL(50.0, supercoil_joint_antagonist_coldest_c_decode(other.antagonist_coldest_c),
                1e-9);
  DOUBLES_EQUAL(61.0, supercoil_joint_antagonist_hottest_c_decode(other.antagonist_hottest_c),
                1e-9);
  const auto its_power = sent(JointPart::antagonist_power, agonist, &antagonist);
  DOUBLES_EQUAL(1.5, supercoil_joint_antagonist_applied_w_decode(its_power.antagonist_applied_w),
                1e-9);
  DOUBLES_EQUAL(
      6.0, supercoil_joint_antagonist_resistance_ohm_decode(its_power.antagonist_resistance_ohm),
      1e-9);
}

/// From the lever's integral: 15 mm at 0, falling by 4 mm to 30°.
TEST(JointFrame, TheAngleUsesAVariableLever) {
  constexpr std::array radii_m{0.012, 0.015, 0.011};
  constexpr double end_rad = 3.14159265358979 / 6.0;
  const control::Lever lever(-end_rad, end_rad, radii_m);
  agonist.position_m =
      static_cast<float>((0.015 - 0.5 * 0.004 / end_rad * end_rad / 3.0) * end_rad / 3.0);
  const auto m = sent(JointPart::motion, agonist, &antagonist, lever);
  DOUBLES_EQUAL(10.0, supercoil_joint_angle_deg_decode(m.angle_deg), 0.0005);
}

TEST(JointFrame, ReferenceAndErrorAreNotAvailableWithoutTracking) {
  agonist.mode = static_cast<std::uint8_t>(Mode::power);
  antagonist.mode = static_cast<std::uint8_t>(Mode::rest);
  const auto motion = sent(JointPart::motion, agonist, &antagonist);
  LONGS_EQUAL(angle_not_available, motion.reference_deg);
  LONGS_EQUAL(-32768, motion.error_deg);
  const auto effort = sent(JointPart::effort, agonist, &antagonist);
  LONGS_EQUAL(-131072, effort.effort_w);
  LONGS_EQUAL(262143, effort.co_contraction_w);
}

TEST(JointFrame, AMuscleAgainstASpringHasItsFourParts) {
  LONGS_EQUAL(4, joint_parts(false));
  LONGS_EQUAL(6, joint_parts(true));
  const auto effort = sent(JointPart::effort, agonist, nullptr);
  DOUBLES_EQUAL(-1.234, supercoil_joint_effort_w_decode(effort.effort_w), 1e-9);
  LONGS_EQUAL(262143, effort.co_contraction_w);
  LONGS_EQUAL(0, effort.antagonist_limited);
  LONGS_EQUAL(0, effort.antagonist_slack);
}

TEST(JointFrame, NaNIsNotAvailableAndExtremesSaturate) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  constexpr float endless = std::numeric_limits<float>::infinity();
  const auto with = [&](float value) {
    for (Row* row : {&agonist, &antagonist}) {
      for (float Row::*member :
           {&Row::position_m, &Row::reference, &Row::model_m, &Row::demanded_W, &Row::applied_W,
            &Row::resistance_Ohm, &Row::coldest_C, &Row::hottest_C})
        row->*member = value;
    }
  };
  with(none);
  auto motion = sent(JointPart::motion, agonist, &antagonist);
  LONGS_EQUAL(angle_not_available, motion.angle_deg);
  LONGS_EQUAL(angle_not_available, motion.reference_deg);
  LONGS_EQUAL(-32768, motion.error_deg);
  LONGS_EQUAL(-131072, sent(JointPart::effort, agonist, &antagonist).effort_w);
  LONGS_EQUAL(262143, sent(JointPart::effort, agonist, &antagonist).co_contraction_w);
  LONGS_EQUAL(-32768, sent(JointPart::agonist_heat, agonist, &antagonist).agonist_coldest_c);
  LONGS_EQUAL(131071, sent(JointPart::agonist_power, agonist, &antagonist).agonist_applied_w);
  LONGS_EQUAL(-32768, sent(JointPart::antagonist_heat, agonist, &antagonist).antagonist_hottest_c);
  LONGS_EQUAL(524287,
              sent(JointPart::antagonist_power, agonist, &antagonist).antagonist_resistance_ohm);
  // The same before the first row of the antagonist.
  LONGS_EQUAL(-32768, sent(JointPart::antagonist_heat, agonist, nullptr).antagonist_coldest_c);
  LONGS_EQUAL(131071, sent(JointPart::antagonist_power, agonist, nullptr).antagonist_applied_w);
  for (const float huge : {1e30F, endless}) {
    with(huge);
    motion = sent(JointPart::motion, agonist, &antagonist);
    // No lever turns through an infinite arc.
    LONGS_EQUAL(huge == endless ? angle_not_available : 524287, motion.angle_deg);
    LONGS_EQUAL(huge == endless ? angle_not_available : 524287, motion.reference_deg);
    LONGS_EQUAL(131071, sent(JointPart::effort, agonist, &antagonist).effort_w);
    LONGS_EQUAL(262142, sent(JointPart::effort, agonist, &antagonist).co_contraction_w);
    LONGS_EQUAL(32767, sent(JointPart::agonist_heat, agonist, &antagonist).agonist_hottest_c);
    const auto power = sent(JointPart::agonist_power, agonist, &antagonist);
    LONGS_EQUAL(131070, power.agonist_applied_w);
    LONGS_EQUAL(524286, power.agonist_resistance_ohm);
    with(-huge);
    LONGS_EQUAL(huge == endless ? angle_not_available : -524287,
                sent(JointPart::effort, agonist, &antagonist).angle_deg);
    LONGS_EQUAL(-131071, sent(JointPart::effort, agonist, &antagonist).effort_w);
    LONGS_EQUAL(0, sent(JointPart::effort, agonist, &antagonist).co_contraction_w);
    LONGS_EQUAL(0, sent(JointPart::agonist_power, agonist, &antagonist).agonist_applied_w);
  }
  agonist = agonist_row();
  agonist.model_m = at_deg(40.0);
  LONGS_EQUAL(-32767, sent(JointPart::motion, agonist, &antagonist).error_deg);
}
