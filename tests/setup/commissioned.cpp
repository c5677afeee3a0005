#include "setup/commissioned.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/sense_comparison.hpp"
#include "config/board_config.hpp"
#include "config/edit_toml.hpp"
#include "runner/use_board.hpp"
#include "scenario/read_scenario.hpp"
#include "setup/listener.hpp"
#include "setup/simulated_link.hpp"

namespace supercoil::test {

namespace {

config::BoardConfig described_board(const HeldOut& muscle, const std::string& controller) {
  using operating::QuestionId;
  auto described = operating::describe_muscle(muscle.answers);
  if (!described) throw std::runtime_error(described.error().text());
  std::vector<operating::Entry>& entries = described->entries;
  entries.insert(entries.end(), muscle.board.begin(), muscle.board.end());
  std::string text = held_out_board(muscle.answers.of(QuestionId::cold_resistance_Ohm),
                                    muscle.answers.of(QuestionId::max_W));
  for (const operating::Entry& entry : entries) {
    auto changed = config::with_value(text, "channel", 0, entry.path, entry.literal);
    if (!changed) throw std::runtime_error(changed.error().text());
    text = std::move(*changed);
  }
  text = config::with_value(text, "channel", 0, "controller.kind", '"' + controller + '"').value();
  auto config = config::parse_board_config(text, "held_out.toml");
  if (!config) throw std::runtime_error(config::to_text(config.error()));
  return std::move(*config);
}

host_sim::Scenario scenario_of(const HeldOut& muscle, const config::BoardConfig& config,
                               double sense_error_ratio) {
  auto scenario = host_sim::parse_scenario(muscle.scenario, "held_out_scenario.toml");
  if (!scenario) throw std::runtime_error(config::to_text(scenario.error()));
  board::Learned compared;
  compared.has_muscle = false;
  compared.senses = {1.0, 1.0, sense_error_ratio, 1.0};
  if (const auto used = host_sim::use_board(*scenario, config, 0, {compared}); !used)
    throw std::runtime_error(used.error().text());
  return std::move(*scenario);
}

}  // namespace

HeldOutBoard::HeldOutBoard(const HeldOut& muscle, const std::string& controller,
                           double sense_error_ratio)
    : config_(described_board(muscle, controller)),
      scenario_(scenario_of(muscle, config_, sense_error_ratio)),
      simulation_(scenario_),
      link_(simulation_, config_.settings.rate_Hz) {}

namespace {

/// Knows nothing but what a meter on the muscle's wires shows.
class MeterReader final : public operating::Operator {
 public:
  static constexpr double supply_V = 12.0;  ///< as the scenario's

  explicit MeterReader(const SimulatedLink& link) : link_(link) {}

  void show(const std::string&) override {}
  void show_progress(const std::string&, double) override {}
  bool sees_progress() const override { return false; }
  bool interrupted() const override { return false; }
  Answer ask(const operating::Question& question, const std::function<Done()>&) override {
    if (question.key == "supply_V") return supply_V;
    if (question.key != "current_A") return failure("no answer: the input has ended");
    currents_A_.push_back(link_.metered_W() / supply_V);
    return currents_A_.back();
  }
  const std::vector<double>& currents_A() const { return currents_A_; }

 private:
  const SimulatedLink& link_;
  std::vector<double> currents_A_;
};

enum class Steps : std::uint8_t { without_answers, without_senses, all };

Commissioned commission(HeldOutBoard& board, operating::Operator& user, Steps answered) {
  const SimulatedLink& link = board.link();
  operating::Commission steps = board.steps(user);
  Commissioned c;
  const auto conclude = [&](const std::string& refused) {
    c.refused = refused;
    c.took_s = link.time_s();
    c.hottest_rise_K = link.hottest_rise_K();
    c.above_hot_end_K = link.above_hot_end_K();
    c.fault = link.fault();
    return c;
  };
  if (answered == Steps::all) {
    if (const auto done = steps.compare_senses(); !done) return conclude(done.error().text());
  }
  if (const auto done = steps.calibrate(); !done) return conclude(done.error().text());
  c.calibrated_s = link.time_s();
  if (const auto done = steps.identify(); !done) return conclude(done.error().text());
  c.identified_s = link.time_s();
  if (answered != Steps::without_answers) {
    if (const auto done = steps.gains(); !done) return conclude(done.error().text());
  }
  const auto moved = steps.move();
  if (!moved) return conclude(moved.error().text());
  c.promised_m = moved->value("promised_m", NAN);
  c.probe_m = moved->value("probe_m", NAN);
  c.pwm_m = moved->value("pwm_m", NAN);
  c.unexplained_m = moved->value("unexplained_m", NAN);
  c.error_m = (*moved)["error_m"];
  c.standing_still_m = (*moved)["standing_still_m"];
  c.travel_m = (1.0 / 0.4) * (*moved)["middle_m"].get<double>();
  return conclude("");
}

}  // namespace

Commissioned commission(const HeldOut& muscle, const std::string& controller) {
  HeldOutBoard board(muscle, controller, 0.02);
  Nobody nobody;
  return commission(board, nobody, Steps::without_answers);
}

Commissioned commission_by_script(const HeldOut& muscle) {
  // The script was made for this board: somebody has read a meter on it before. Where the
  // description allows too little power for the senses, the script leaves that step out.
  HeldOutBoard first(muscle, "learned_ff", 0.0);
  MeterReader reader(first.link());
  const bool compared = first.steps(reader).compare_senses().has_value();
  HeldOutBoard board(muscle, "learned_ff", 0.0);
  const double power_W = operating::plan_comparison("1", board.channel(), board.settings()).power_W;
  operating::ScriptedAnswers script("study");
  script.add("senses", "power_W", {power_W});
  script.add("senses", "supply_V", {MeterReader::supply_V});
  if (compared) script.add("senses", "current_A", reader.currents_A());
  script.add("muscle", "take_gains", {1.0});
  Listener listener(std::move(script));
  return commission(board, listener, compared ? Steps::all : Steps::without_senses);
}

}  // namespace supercoil::test
