// The steps of setup that ask a person: senses by a meter, the position's scale by a ruler, whether
// to take another controller; in lockstep.
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "apps/supercoil/setup/channel_steps.hpp"
#include "apps/supercoil/setup/sense_comparison.hpp"
#include "setup/commissioned.hpp"
#include "setup/listener.hpp"

using namespace supercoil;
using namespace supercoil::test;
using operating::Question;

namespace {

constexpr double supply_V = 12.0;

/// A person with a meter and a ruler, who reads them for a second and tells what they show.
class Person final : public operating::Operator {
 public:
  explicit Person(SimulatedLink& link) : link_(link) {}

  void show(const std::string& line) override {
    std::sscanf(line.c_str(), "channel 1 gets %lf W", &power_W_);
    output_ += line + "\n";
  }
  void show_progress(const std::string&, double) override {}
  bool sees_progress() const override { return false; }
  bool interrupted() const override { return cancels; }
  Answer ask(const Question& question, const std::function<Done()>& meanwhile) override {
    ++questions;
    for (int i = 0; i < answer_delay_polls; ++i) {
      if (auto goes_on = meanwhile(); !goes_on) return tl::unexpected(goes_on.error());
      link_.wait(look_every);
    }
    if (question.key == "take_gains") {
      if (cancels) return failure("interrupted");
      return gains;
    }
    if (question.key == "reset_fault")
      return std::isnan(resets) ? Answer(failure("no answer: the input has ended")) : resets;
    if (question.key == "supply_V") return supply_V;
    if (question.key == "place_mm") return place_mm;
    const double slip = currents_read_++ == 1 ? second_reading_ratio : 1.0;
    return slip * power_W_ / supply_V;
  }

  const std::string& output() const { return output_; }

  double second_reading_ratio = 1.0;  ///< of amperes, told over shown
  double place_mm = NAN;
  double gains = NAN;   ///< 1: takes what is recommended
  double resets = NAN;  ///< 1: a fault from before
  int answer_delay_polls = 20;
  int questions = 0;
  bool cancels = false;

 private:
  SimulatedLink& link_;
  double power_W_ = 0.0;
  int currents_read_ = 0;
  std::string output_;
};

HeldOut pulled_by(double force_N) {
  HeldOut muscle = held_out_muscle(24, 0.3);
  muscle.scenario += "[[event]]\nat_s = 90.0\nplant.load_N = " + std::to_string(force_N) + "\n";
  return muscle;
}

/// A tunable of controller 0 on the board, by its name.
double tuned(HeldOutBoard& board, std::string_view name, TuningSet set) {
  return board.link().tuning("1", 0, control::tunable_named(name), set).value();
}

/// What a meter shows at half and at all of that power.
operating::ScriptedAnswers meter_readings(double power_W, double shown_V = supply_V) {
  operating::ScriptedAnswers script("answers.toml");
  script.add("senses", "power_W", {power_W});
  script.add("senses", "supply_V", {shown_V});
  script.add("senses", "current_A", {0.5 * power_W / supply_V, power_W / supply_V});
  return script;
}

/// As after a master that was killed while it heated.
void let_a_command_expire(HeldOutBoard& board) {
  STRCMP_EQUAL("ok", board.link().ask("1 disarm")->c_str());
  STRCMP_EQUAL("ok", operating::arm(board.link(), "1")->c_str());
  STRCMP_EQUAL("ok", board.link().ask("1 power 0.01")->c_str());
  board.link().wait(std::chrono::seconds(2));
}

constexpr auto adaptive_ff = static_cast<double>(control::ControllerKind::adaptive_ff);
constexpr auto learned_ff = static_cast<double>(control::ControllerKind::learned_ff);

}  // namespace

TEST_GROUP(GuidedSteps){
    /// A comparison that comes to nothing; returns the time of its end, in s.
    static double ends_with(const char* why, const std::function<void(Person&)>& change){
        HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.0);
Person person(board.link());
change(person);
const auto found = board.steps(person).compare_senses();
CHECK_FALSE(found.has_value());
STRCMP_CONTAINS(why, found.error().text().c_str());
CHECK_FALSE(board.link().senses("1")->compared());
STRCMP_EQUAL("disarmed", board.link().status("1")->state.c_str());
return board.link().time_s();
}
}
;

TEST(GuidedSteps, MeterReadingsNarrowThePowerBounds) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.0);
  Person person(board.link());
  const auto found = board.steps(person).compare_senses();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  DOUBLES_EQUAL(1.0, (*found)["supply_gain"].get<double>(), 0.01);
  DOUBLES_EQUAL(1.0, (*found)["current_gain"].get<double>(), 0.02);
  CHECK((*found)["error_ratio"].get<double>() < 0.06);
  STRCMP_CONTAINS("the true power is 0.9", person.output().c_str());
  STRCMP_CONTAINS(
      " W, each for 2.5 s and then while you answer two questions, at most 5 min each\n",
      person.output().c_str());
  CHECK(person.output().find("heats it with ") < person.output().find("channel 1 gets "));
  STRCMP_EQUAL("disarmed", board.link().status("1")->state.c_str());
}

TEST(GuidedSteps, AScriptGivesTheMeterReadingsAtBothPowers) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.0);
  const double power_W =
      0.8 * operating::plan_comparison("1", board.channel(), board.settings()).power_W;
  Listener listener(meter_readings(power_W));
  const auto found = board.steps(listener).compare_senses();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  DOUBLES_EQUAL(power_W, (*found)["power_W"].get<double>(), 0.0);
  DOUBLES_EQUAL(1.0, (*found)["supply_gain"].get<double>(), 0.01);
  DOUBLES_EQUAL(1.0, (*found)["current_gain"].get<double>(), 0.02);
}

TEST(GuidedSteps, AnImpossibleScriptedReadingIsRefusedWithItsRange) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.0);
  const double max_W = operating::plan_comparison("1", board.channel(), board.settings()).power_W;
  const auto refused = [&](const operating::ScriptedAnswers& script) {
    Listener listener(script);
    const auto found = board.steps(listener).compare_senses();
    CHECK_FALSE(found.has_value());
    STRCMP_EQUAL("disarmed", board.link().status("1")->state.c_str());
    return found.error().text();
  };
  STRCMP_CONTAINS("answers.toml: senses.power_W = ", refused(meter_readings(1.2 * max_W)).c_str());
  const std::string max_text = " to " + operating::range_text({0.0, max_W}).substr(5) + " here";
  STRCMP_CONTAINS(max_text.c_str(), refused(meter_readings(1.2 * max_W)).c_str());
  CHECK(board.link().time_s() < 20.0);  // nothing was heated
  STRCMP_CONTAINS("answers.toml: senses.supply_V = 30: must be ",
                  refused(meter_readings(max_W, 30.0)).c_str());
}

TEST(GuidedSteps, AFaultThatPreventsArmingIsReportedWithItsReset) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.0);
  let_a_command_expire(board);
  Person person(board.link());
  for (const char* step : {"senses", "calibrate", "limits", "identify", "move"}) {
    const auto found = board.steps(person).run(step);
    CHECK_FALSE(found.has_value());
    STRCMP_CONTAINS(
        "fault command_timeout; see faults/command_timeout in `supercoil docs`; when its cause is "
        "gone: supercoil command 1 reset",
        found.error().text().c_str());
  }
  STRCMP_EQUAL("ok", board.link().ask("1 reset")->c_str());
  CHECK(board.steps(person).calibrate().has_value());
}

TEST(GuidedSteps, AnEarlierFaultIsReportedAndResetOnConfirmation) {
  const std::string notice =
      "channel 1: fault command_timeout; see faults/command_timeout in `supercoil docs`; when its "
      "cause is gone: ";
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.0);
  let_a_command_expire(board);
  Person person(board.link());
  person.resets = 0.0;
  const auto left = board.steps(person).calibrate();
  CHECK_FALSE(left.has_value());
  STRCMP_CONTAINS("cannot be armed: fault command_timeout", left.error().text().c_str());
  STRCMP_EQUAL("command_timeout", board.link().status("1")->fault.c_str());
  person.resets = 1.0;
  CHECK(board.steps(person).calibrate().has_value());
  STRCMP_CONTAINS(notice.c_str(), person.output().c_str());
  LONGS_EQUAL(2, person.questions);
  // Without a fault nothing is asked.
  CHECK(board.steps(person).calibrate().has_value());
  LONGS_EQUAL(2, person.questions);
  for (const double allowed : {0.0, 1.0}) {
    let_a_command_expire(board);
    operating::ScriptedAnswers script("answers.toml");
    script.add("muscle", "reset_fault", {allowed});
    Listener nobody(script);
    LONGS_EQUAL(allowed > 0.0, board.steps(nobody).calibrate().has_value());
    STRCMP_CONTAINS(notice.c_str(), nobody.take().c_str());
    static_cast<void>(board.link().ask("1 reset"));
  }
}

TEST(GuidedSteps, AContradictoryReadingChangesNothing) {
  ends_with("contradicts the others", [](Person& person) { person.second_reading_ratio = 1.25; });
}

TEST(GuidedSteps, HeatingEndsAfterFiveMinutesWithoutAnAnswer) {
  CHECK(ends_with("no answer within 5 minutes",
                  [](Person& person) { person.answer_delay_polls = 10000; }) < 330.0);
}

TEST(GuidedSteps, AnInterruptionEndsTheHeating) {
  CHECK(ends_with("interrupted", [](Person& person) { person.cancels = true; }) < 30.0);
}

TEST(GuidedSteps, ASecondKnownPositionGivesTheScale) {
  HeldOutBoard board(pulled_by(-0.03), "learned_ff", 0.02);
  Person person(board.link());
  operating::Commission steps = board.steps(person);
  CHECK(steps.calibrate().has_value());
  board.link().wait(std::chrono::seconds(120));
  const double shown_m = board.simulation().loop().channel(0).snapshot().position_m;
  CHECK(shown_m > 1e-4);
  person.place_mm = 1e3 * 1.1 * shown_m;
  const auto found = steps.scale();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  DOUBLES_EQUAL(1.1, (*found)["position_scale"].get<double>(), 0.02);
  STRCMP_CONTAINS("scale of the position: ", person.output().c_str());
}

TEST(GuidedSteps, AScriptGivesTheSecondPosition) {
  HeldOutBoard board(pulled_by(-0.03), "learned_ff", 0.02);
  operating::ScriptedAnswers script("answers.toml");
  script.add("scale", "place_mm", {1e6});
  Listener listener(script);
  CHECK(board.steps(listener).calibrate().has_value());
  board.link().wait(std::chrono::seconds(120));
  STRCMP_CONTAINS("answers.toml: scale.place_mm = 1000000: must be ",
                  board.steps(listener).scale().error().text().c_str());
  const double shown_m = board.simulation().loop().channel(0).snapshot().position_m;
  script.add("scale", "place_mm", {1e3 * 1.1 * shown_m});
  Listener again(script);
  const auto found = board.steps(again).scale();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  DOUBLES_EQUAL(1.1, (*found)["position_scale"].get<double>(), 0.02);
}

TEST(GuidedSteps, AnImplausibleScaleIsRefused) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  Person person(board.link());
  person.place_mm = 5.0;  // the muscle rests at its zero
  const auto found = board.steps(person).scale();
  CHECK(!found);
  STRCMP_CONTAINS("scale 0.005: refused: out_of_range; the sensor shows ",
                  found.error().text().c_str());
}

TEST(GuidedSteps, TheRecommendedControllerIsAppliedStoredAndTracksAsPromised) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "adaptive_ff", 0.02);
  Person person(board.link());
  person.gains = 1.0;
  operating::Commission steps = board.steps(person);
  CHECK(steps.calibrate().has_value());
  CHECK(steps.identify().has_value());
  const auto found = steps.gains();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  CHECK((*found)["taken"].get<bool>());
  CHECK((*found)["in_use_promised_m"].is_null());
  const double bandwidth = (*found)["recommended_bandwidth_rad_per_s"];
  const double found_tau_s = (*board.link().muscle("1"))[0] / (*board.link().muscle("1"))[1];
  DOUBLES_EQUAL(8.0 / std::sqrt(std::fmax(1.0, found_tau_s / 1.82)), bandwidth, 1e-9);
  const double pole = (*found)["recommended_pole_rad_per_s"];
  CHECK(pole > 1.0 / found_tau_s);
  for (const TuningSet set : {TuningSet::in_use, TuningSet::stored}) {
    DOUBLES_EQUAL(learned_ff, tuned(board, "kind", set), 0.0);
    DOUBLES_EQUAL(1.0, tuned(board, "shape_reference", set), 0.0);
    DOUBLES_EQUAL(bandwidth, tuned(board, "bandwidth_rad_per_s", set), 1e-9);
    DOUBLES_EQUAL(0.0, tuned(board, "reference_model", set), 0.0);
    for (const char* pole_key :
         {"model_pole_1_rad_per_s", "model_pole_2_rad_per_s", "model_pole_3_rad_per_s"})
      DOUBLES_EQUAL(pole, tuned(board, pole_key, set), 1e-9);
  }
  STRCMP_CONTAINS("with reference_model = { kind = \"poles\"", person.output().c_str());
  STRCMP_CONTAINS("promises no error", person.output().c_str());
  STRCMP_CONTAINS("no parameter is off by more than", person.output().c_str());
  const double begin_s = board.link().time_s();
  const auto moved = steps.move();
  STRCMP_EQUAL("", moved ? "" : moved.error().text().c_str());
  DOUBLES_EQUAL((*found)["recommended_promised_m"].get<double>(), moved->value("promised_m", NAN),
                1e-12);
  CHECK(moved->value("kept", false));
  double announced_s = 0.0;
  std::sscanf(person.output().c_str() + person.output().find("moves for "),
              "moves for %lf s: three", &announced_s);
  DOUBLES_EQUAL(board.link().time_s() - begin_s, announced_s, 3.0);
}

TEST(GuidedSteps, DecliningTheRecommendedControllerChangesNothing) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "adaptive_ff", 0.02);
  Person person(board.link());
  person.gains = 0.0;
  const auto found = board.steps(person).gains();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  CHECK_FALSE((*found)["taken"].get<bool>());
  STRCMP_CONTAINS("kept as it is", person.output().c_str());
  person.cancels = true;
  STRCMP_EQUAL("interrupted", board.steps(person).gains().error().text().c_str());
  for (const TuningSet set : {TuningSet::in_use, TuningSet::stored})
    DOUBLES_EQUAL(adaptive_ff, tuned(board, "kind", set), 0.0);
}

TEST(GuidedSteps, NoQuestionIfTheRecommendedControllerIsInUse) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  Person person(board.link());
  const auto found = board.steps(person).gains();
  STRCMP_EQUAL("", found ? "" : found.error().text().c_str());
  CHECK_FALSE((*found)["taken"].get<bool>());
  LONGS_EQUAL(0, person.questions);
  STRCMP_CONTAINS("it is in use already", person.output().c_str());
}

TEST(GuidedSteps, AnUnsuitableRecommendedControllerIsNotOffered) {
  HeldOutBoard board(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  Person person(board.link());
  auto now = operating::channel_now(board.link(), "1", board.channel());
  now->settings.controllers.front().kind = control::ControllerKind::pi;
  now->settings.controllers.front().arithmetic = control::Arithmetic::q8_24;
  const auto found = operating::choose_gains(board.link(), "1", *now, board.settings(), person);
  CHECK_FALSE((*found)["taken"].get<bool>());
  LONGS_EQUAL(0, person.questions);
  STRCMP_CONTAINS("it cannot run here: controller.arithmetic must be double or float",
                  person.output().c_str());
}
