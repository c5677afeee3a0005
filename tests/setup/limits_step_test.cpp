// The step of setup that finds how far a muscle may move, in lockstep.
#include <cmath>
#include <optional>
#include <string>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "apps/supercoil/setup/channel_steps.hpp"
#include "apps/supercoil/setup/stall_watch.hpp"
#include "setup/commissioned.hpp"
#include "setup/listener.hpp"

using namespace supercoil;
using namespace supercoil::test;
using operating::Question;
using operating::travel_key;

namespace {

/// A person who watches the muscle's end, and answers when it has reached a place.
class Watcher final : public operating::Operator {
 public:
  explicit Watcher(HeldOutBoard& board) : board_(board) {}

  void show(const std::string& line) override { output += line + "\n"; }
  void show_progress(const std::string&, double) override {}
  bool sees_progress() const override { return false; }
  bool interrupted() const override { return true_position_m() > cancels_at_m; }
  Answer ask(const Question& question, const std::function<Done()>& meanwhile) override {
    CHECK_TRUE(question.key == "at_limit");
    while (true_position_m() < answers_at_m) {
      if (auto goes_on = meanwhile(); !goes_on) return tl::unexpected(goes_on.error());
      board_.link().wait(look_every);
    }
    return answer;
  }
  double true_position_m() const { return board_.simulation().plant().position_m(); }

  double answers_at_m = INFINITY;
  double answer = 1.0;
  double cancels_at_m = INFINITY;
  std::string output;

 private:
  HeldOutBoard& board_;
};

/// effect: a line of the scenario's [plant].
HeldOut muscle_with(unsigned seed, const std::string& effect) {
  HeldOut muscle = held_out_muscle(seed, 0.3);
  muscle.scenario += effect + "\n";
  return muscle;
}

double limit_m(const operating::StepResult& found) {
  CHECK(found && found->contains(travel_key));
  return std::stod((*found)[travel_key].get<std::string>());
}

}  // namespace

TEST_GROUP(LimitsStep) {
  std::optional<HeldOutBoard> board;
  std::optional<Watcher> watcher;

  operating::StepResult run_limits_on(const HeldOut& muscle, double answers_at_m,
                                      double answer = 1.0) {
    board.emplace(muscle, "learned_ff", 0.02);
    watcher.emplace(*board);
    watcher->answers_at_m = answers_at_m;
    watcher->answer = answer;
    return run_limits();
  }
  operating::StepResult run_limits() {
    auto steps = board->steps(*watcher);
    auto found = steps.limits();
    STRCMP_EQUAL("disarmed", board->link().status("1")->state.c_str());
    CHECK(board->link().fault() == Fault::none);
    return found;
  }
};

TEST(LimitsStep, AnAnswerReleasesAtOnceAndTheLimitKeepsAMargin) {
  const auto limits = run_limits_on(held_out_muscle(24, 0.3), 0.002);
  STRCMP_EQUAL("", limits ? "" : limits.error().text().c_str());
  DOUBLES_EQUAL(0.0015, limit_m(limits), 5e-5);
  CHECK(limit_m(limits) < board->channel().supervision.max_travel_m);
  STRCMP_CONTAINS("pulls with a power that rises to ", watcher->output.c_str());
  STRCMP_CONTAINS(" mm, or after ", watcher->output.c_str());
  STRCMP_CONTAINS("limit: 1.5 mm", watcher->output.c_str());
  board->link().wait(std::chrono::seconds(1));
  CHECK(watcher->true_position_m() < 0.0019);
}

TEST(LimitsStep, AScriptGivesTheReleasePosition) {
  board.emplace(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  operating::ScriptedAnswers script("answers.toml");
  script.add("limits", "stop_mm", {2.0});
  Listener listener(script);
  const auto limits = board->steps(listener).limits();
  STRCMP_EQUAL("", limits ? "" : limits.error().text().c_str());
  DOUBLES_EQUAL(0.0015, limit_m(limits), 5e-5);
  const std::string output = listener.take();
  STRCMP_CONTAINS("lets go where the script says, when its end stops rising, at ", output.c_str());
  STRCMP_CONTAINS("let go at 2.0", output.c_str());
  STRCMP_EQUAL("disarmed", board->link().status("1")->state.c_str());
}

TEST(LimitsStep, AnInvalidScriptedPositionIsRefusedBeforeHeating) {
  board.emplace(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  for (const double stop_mm : {1.4, 1e3 * board->channel().supervision.max_travel_m}) {
    operating::ScriptedAnswers script("answers.toml");
    script.add("limits", "stop_mm", {stop_mm});
    Listener listener(script);
    const auto limits = board->steps(listener).limits();
    CHECK_FALSE(limits.has_value());
    STRCMP_CONTAINS("answers.toml: limits.stop_mm = ", limits.error().text().c_str());
    STRCMP_CONTAINS(": must be 1.51 to ", limits.error().text().c_str());
  }
  CHECK(board->simulation().plant().temperature_rise_K() < 0.5);
}

TEST(LimitsStep, WarnsIfTheBoardWasNeverCalibrated) {
  CHECK_TRUE(run_limits_on(held_out_muscle(24, 0.3), 0.002).has_value());
  STRCMP_CONTAINS("warning: this board was never calibrated", watcher->output.c_str());
  CHECK_TRUE(board->steps(*watcher).calibrate().has_value());
  watcher->output.clear();
  CHECK_TRUE(run_limits().has_value());
  CHECK_TRUE(watcher->output.find("never calibrated") == std::string::npos);
}

TEST(LimitsStep, AMuscleThatTouchesSomethingIsReleasedAutomatically) {
  for (const unsigned seed : {24U, 37U, 66U, 45U, 73U}) {
    const auto limits = run_limits_on(muscle_with(seed, "ceiling_m = 0.002"), INFINITY);
    STRCMP_EQUAL("", limits ? "" : limits.error().text().c_str());
    STRCMP_CONTAINS("it seems to touch something at ", watcher->output.c_str());
    DOUBLES_EQUAL(0.0015, limit_m(limits), 1e-4);
  }
}

TEST(LimitsStep, ASlowingMuscleIsNotMistakenForContact) {
  const HeldOut cooled_better_when_hot = muscle_with(24, "convection_ratio = 1.0");
  for (const HeldOut& muscle : {cooled_better_when_hot, held_out_muscle(37, 0.3),
                                held_out_muscle(45, 0.3), held_out_muscle(73, 0.3)}) {
    const auto limits = run_limits_on(muscle, INFINITY);
    STRCMP_EQUAL("", limits ? "" : limits.error().text().c_str());
    CHECK_FALSE(limits->contains(travel_key));
    STRCMP_CONTAINS("touched nothing: the limit stays", watcher->output.c_str());
  }
}

TEST(LimitsStep, APositionThatLeavesNoTravelIsRefused) {
  const auto limits = run_limits_on(held_out_muscle(24, 0.3), 0.0012);
  CHECK_FALSE(limits.has_value());
  STRCMP_CONTAINS("leaves no travel, less than 1 mm; nothing changed",
                  limits.error().text().c_str());
}

TEST(LimitsStep, ReleasingWithoutALimitChangesNothing) {
  const auto limits = run_limits_on(held_out_muscle(24, 0.3), 0.002, 0.0);
  CHECK(limits.has_value() && !limits->contains(travel_key));
  STRCMP_CONTAINS("let go at 2.0", watcher->output.c_str());
}

/// A bus on which no position has been heard yet.
class SilentLink final : public SimulatedLink {
 public:
  using SimulatedLink::SimulatedLink;
  Result<double> position_m(const std::string&) override { return NAN; }
};

TEST(LimitsStep, AnAnswerBeforeTheFirstPositionChangesNothing) {
  board.emplace(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  watcher.emplace(*board);
  watcher->answers_at_m = -1.0;  // at once
  SilentLink silent(board->simulation(), board->settings().rate_Hz);
  operating::Commission steps(silent, "1", board->settings(), 0, *watcher);
  const auto limits = steps.limits();
  CHECK_FALSE(limits.has_value());
  STRCMP_EQUAL("answered before the board reported a position; nothing changed",
               limits.error().text().c_str());
  watcher->answer = 0.0;
  const auto left = steps.limits();
  CHECK(left.has_value() && left->at("position_m").is_null() && !left->contains(travel_key));
  STRCMP_CONTAINS("let go before the board reported a position; the limit stays",
                  watcher->output.c_str());
}

TEST(LimitsStep, AnInterruptionEndsTheHeating) {
  board.emplace(held_out_muscle(24, 0.3), "learned_ff", 0.02);
  watcher.emplace(*board);
  watcher->cancels_at_m = 0.002;
  const auto limits = run_limits();
  CHECK_FALSE(limits.has_value());
  STRCMP_CONTAINS("interrupted", limits.error().text().c_str());
  board->link().wait(std::chrono::seconds(1));
  CHECK(watcher->true_position_m() < 0.0019);
}

/// Equal steps of power, of which the later ones bring `ratio` of the first ones' motion.
TEST(LimitsStep, AStepOfLessThanAFifthIsAStall) {
  constexpr double noise_m = 10e-6;
  const auto stalls = [](double ratio, double first_m) {
    operating::StallWatch watch(0.1, noise_m);
    double position_m = 0.0;
    for (int step = 0; step < 20; ++step) {
      if (watch.step(0.1 * step + 1e-9, position_m)) return true;
      position_m += step < 10 ? first_m : ratio * first_m;
    }
    return false;
  };
  CHECK_TRUE(stalls(0.0, 1e-3));
  CHECK_TRUE(stalls(0.15, 1e-3));
  CHECK_FALSE(stalls(0.25, 1e-3));
  CHECK_FALSE(stalls(0.5, 1e-3));
  // Steps that may be noise prove nothing.
  CHECK_FALSE(stalls(0.0, 5.0 * noise_m));
}
