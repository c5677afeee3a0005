#include "runner/mode_outcome.hpp"

#include <algorithm>

#include "text/documentation.hpp"
#include "text/result_words.hpp"

namespace supercoil::host_sim {

namespace {

bool is_mode_request(const Conditions& c) {
  return c.action == OperatorAction::identify || c.action == OperatorAction::calibrate;
}

}  // namespace

std::string describe_mode(const Snapshot& snapshot) {
  if (snapshot.result == ModeResult::none) return {};
  std::string text = result_text(snapshot.result, snapshot.identify_notes);
  if (snapshot.result == ModeResult::running) text += "; give it a longer simulation.duration_s";
  return text + " (see " + documentation_page("running") + ")";
}

std::string mode_failed_because(const Scenario& scenario, const Simulation& simulation) {
  const bool requested = is_mode_request(scenario.start) ||
                         std::ranges::any_of(scenario.events, [](const Event& event) {
                           return is_mode_request(event.conditions);
                         });
  const Snapshot& snapshot = simulation.loop().channel(0).snapshot();
  const bool found =
      snapshot.result == ModeResult::found || snapshot.result == ModeResult::not_stored;
  return requested && !found ? describe_mode(snapshot) : std::string();
}

}  // namespace supercoil::host_sim
