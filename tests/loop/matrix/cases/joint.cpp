#include "loop/matrix/cases/cases.hpp"

namespace supercoil::test {

namespace {

/// End stops within the travel: otherwise a torn muscle causes over_travel of the other one.
void end_stops(RigSettings& s) {
  host_sim::JointPlantSettings& joint = s.board.joints[0].plant;
  joint.min_angle_rad = -0.4;
  joint.max_angle_rad = 0.4;
}

FaultCase loose(const std::string& how, const std::function<void(Rig&, bool)>& inject) {
  return {.fault = Fault::muscle_loose,
          .how = how,
          .within = {2.0},
          .elsewhere = cold,
          .why_not = "a muscle that is not asked for anything need not move",
          .inject = [inject](Rig& r) { inject(r, true); },
          .remove = [inject](Rig& r) { inject(r, false); },
          .tune = end_stops};
}

}  // namespace

std::vector<FaultCase> joint_cases() {
  return {
      loose("the agonist is torn",
            [](Rig& r, bool on) { r.board.channel(Rig::tested).faults.torn = on; }),
      loose("the antagonist is torn",
            [](Rig& r, bool on) { r.board.channel(Rig::neighbour).faults.torn = on; }),
      loose("the agonist's cable is slack",
            [](Rig& r, bool on) { r.board.channel(Rig::tested).faults.slack_m = on ? 0.2 : 0.0; }),
      loose(
          "the antagonist's cable is slack",
          [](Rig& r, bool on) { r.board.channel(Rig::neighbour).faults.slack_m = on ? 0.2 : 0.0; }),
  };
}

}  // namespace supercoil::test
