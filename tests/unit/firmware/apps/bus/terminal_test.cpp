// What is shown of a node of which only some frames were received.
#include "apps/supercoil/bus/terminal.hpp"

#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>

#include "apps/supercoil/bus/state_json.hpp"
#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "loop/snapshot.hpp"
#include "telemetry/joint_frame.hpp"

using namespace supercoil;
using namespace supercoil::operating;

TEST_GROUP(Terminal) {
  FrameHistory history{10.0, 500e3};

  std::string shown() const {
    return state_text(history, {{1, "mrac"}});
  }
};

TEST(Terminal, WithoutAStatusNoControllerIsShown) {
  can::Encoder<can::message::measurement> frame(can::Node{1});
  frame.set("position_m", 0.005);
  history.add({frame.frame()});
  STRCMP_CONTAINS("node 1: -, -\n  position          5.000 mm", shown().c_str());
}

TEST(Terminal, AQuestionToANodeDoesNotProveThatItExists) {
  for (const can::MessageInfo& message : can::all_messages) {
    FrameHistory asked{10.0, 500e3};
    hal::CanFrame frame;
    frame.id = can::id_of(message, can::Node{63});
    frame.length = message.length;
    asked.add({frame});
    LONGS_EQUAL(message.to_node ? 0 : 1, asked.nodes().size());
    LONGS_EQUAL(message.to_node ? 0 : 1, state_json(asked)["nodes"].size());
    CHECK_EQUAL(message.to_node, state_text(asked).find("node 63") == std::string::npos);
  }
  CHECK_TRUE(can::message::tuning_read.to_node);
  CHECK_FALSE(can::message::tuning.to_node);
}

/// It does not matter which part of Joint came last.
TEST(Terminal, TheNodeOfAJointHasItsAngle) {
  Row agonist{};
  agonist.position_m = 0.005236F;
  for (const telemetry::JointPart part :
       {telemetry::JointPart::motion, telemetry::JointPart::agonist_heat}) {
    history.add({telemetry::joint(1, part, control::Lever(0.015), agonist, nullptr)});
    STRCMP_CONTAINS("  angle            20.000 deg\n  position", shown().c_str());
  }
  agonist.position_m = NAN;
  history.add(
      {telemetry::joint(1, telemetry::JointPart::motion, control::Lever(0.015), agonist, nullptr)});
  STRCMP_CONTAINS("  angle                 - deg\n", shown().c_str());
}

TEST(Terminal, OnlyANodeOfAJointHasAnAngle) {
  history.add({can::Encoder<can::message::measurement>(can::Node{1}).frame()});
  CHECK(shown().find("angle") == std::string::npos);
}

/// A different part that came since leaves the value as it was; its own part withdraws it.
TEST(Terminal, JsonOmitsValuesThatAreNoLongerAvailable) {
  Row agonist{};
  agonist.mode = static_cast<std::uint8_t>(Mode::position);
  agonist.reference = 0.005236F;
  const auto reference_after = [&](telemetry::JointPart part) {
    history.add({telemetry::joint(1, part, control::Lever(0.015), agonist, nullptr)});
    return state_json(history)["nodes"][0]["Joint"]["reference_deg"];
  };
  DOUBLES_EQUAL(20.0, reference_after(telemetry::JointPart::motion).get<double>(), 1e-3);
  agonist.mode = static_cast<std::uint8_t>(Mode::rest);
  DOUBLES_EQUAL(20.0, reference_after(telemetry::JointPart::effort).get<double>(), 1e-3);
  CHECK(reference_after(telemetry::JointPart::motion).is_null());
}

TEST(Terminal, AfterARestartOfTheSourceOnlyItsNewFramesAreShown) {
  can::Encoder<can::message::measurement> frame(can::Node{1});
  const auto add = [&](double time_s) {
    frame.frame().received = hal::duration_from(time_s);
    history.add({frame.frame()});
  };
  for (const double time_s : {1000.0, 1000.5, 1000.49, 1000.6})
    add(time_s);
  LONGS_EQUAL(4, history.end());
  LONGS_EQUAL(4, history.since(0).frames.size());
  add(3.0);
  add(5.0);
  const FrameHistory::Part part = history.since(0);
  LONGS_EQUAL(2, part.frames.size());
  LONGS_EQUAL(6, part.next);
  DOUBLES_EQUAL(1.0, history.figures().frames_per_s, 1e-9);
}

TEST(Terminal, AModeWithoutProgressShowsNoPercentage) {
  can::Encoder<can::message::status> frame(can::Node{1});
  frame.set("mode", static_cast<double>(Mode::identify)).set("progress", NAN);
  history.add({frame.frame()});
  const std::string text = shown();
  const std::string of_node = text.substr(text.find("node 1"));
  STRCMP_CONTAINS(", identify, mrac (controller 0)", of_node.c_str());
  CHECK(of_node.find('%') == std::string::npos);
}

TEST(Terminal, TheResultOfIdentifyIsShownOnceWithItsMeaning) {
  can::Encoder<can::message::status> status(can::Node{1});
  status.set("result", static_cast<double>(ModeResult::too_little_motion));
  history.add({status.frame()});
  can::Encoder<can::message::estimate> estimate(can::Node{1});
  estimate.set("identify_notes", note_too_little_motion + note_theta1_kept);
  history.add({estimate.frame()});
  STRCMP_CONTAINS(
      ", last identification or calibration: too_little_motion: the muscle moved by less than 1 % "
      "of its travel at the maximum power; theta1_kept\n",
      shown().c_str());
}
