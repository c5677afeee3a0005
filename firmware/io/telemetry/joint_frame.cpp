#include "telemetry/joint_frame.hpp"

#include <cmath>
#include <numbers>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"

namespace supercoil::telemetry {

namespace {

bool has(const Row* row, RowFlag flag) {
  return row != nullptr && (row->flags & flag) != 0;
}

double in_mode(const Row& row, Mode mode, double value) {
  return row.mode == static_cast<std::uint8_t>(mode) ? value : NAN;
}

}  // namespace

hal::CanFrame joint(can::Node node, JointPart part, const control::Lever& lever, const Row& agonist,
                    const Row* antagonist) {
  const auto angle_deg = [&lever](double position_m) {
    return lever.angle_rad(position_m) * 180.0 / std::numbers::pi;
  };
  can::Encoder<can::message::joint> frame(node);
  frame.set("part", static_cast<double>(part))
      .set("agonist_limited", has(&agonist, row_limited))
      .set("agonist_slack", has(&agonist, row_slack))
      .set("antagonist_limited", has(antagonist, row_limited))
      .set("antagonist_slack", has(antagonist, row_slack))
      .set("angle_deg", angle_deg(agonist.position_m));
  const auto of_antagonist = [antagonist](float Row::*quantity) {
    return antagonist != nullptr ? antagonist->*quantity : NAN;
  };
  switch (part) {
    case JointPart::motion: {
      const double error_deg = angle_deg(agonist.position_m) - angle_deg(agonist.model_m);
      frame.set("reference_deg", in_mode(agonist, Mode::position, angle_deg(agonist.reference)))
          .set("error_deg", in_mode(agonist, Mode::position, error_deg));
      break;
    }
    case JointPart::effort: {
      const double shared_W =
          antagonist != nullptr ? in_mode(*antagonist, Mode::joint, antagonist->demanded_W) : NAN;
      frame.set("effort_W", in_mode(agonist, Mode::position, agonist.demanded_W))
          .set("co_contraction_W", shared_W);
      break;
    }
    case JointPart::agonist_heat:
      frame.set("agonist_coldest_C", agonist.coldest_C).set("agonist_hottest_C", agonist.hottest_C);
      break;
    case JointPart::agonist_power:
      frame.set("agonist_applied_W", agonist.applied_W)
          .set("agonist_resistance_Ohm", agonist.resistance_Ohm);
      break;
    case JointPart::antagonist_heat:
      frame.set("antagonist_coldest_C", of_antagonist(&Row::coldest_C))
          .set("antagonist_hottest_C", of_antagonist(&Row::hottest_C));
      break;
    case JointPart::antagonist_power:
      frame.set("antagonist_applied_W", of_antagonist(&Row::applied_W))
          .set("antagonist_resistance_Ohm", of_antagonist(&Row::resistance_Ohm));
      break;
  }
  return frame.frame();
}

}  // namespace supercoil::telemetry
