#include "runner/mode_outcome.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace supercoil::host_sim {

namespace {

/// In the order of ModeResult.
constexpr std::array<const char*, mode_result_names.size()> sentences{
    "",
    "it had not ended when the run did: a longer simulation.duration_s lets it",
    "",
    "by another command or a fault",
    "the muscle did not cool in time",
    "the position changed while its zero was taken",
    "the muscle did not do what the fit predicted",
    "the fit leaves a parameter open that a controller needs",
    "what it found is out of range, or far from what was believed",
    "it is used, and earlier results still wait to be stored",
    "the muscle moved by less than 1 % of its travel with all the power that it may have",
    "heat moved the muscle away from where it should"};

bool asks_for_mode(const Conditions& c) {
  return c.action == OperatorAction::identify || c.action == OperatorAction::calibrate;
}

}  // namespace

std::string describe_mode(const Snapshot& snapshot) {
  if (snapshot.result == ModeResult::none) return {};
  const auto place = static_cast<std::size_t>(snapshot.result);
  std::string text(mode_result_names.at(place));
  if (const std::string sentence = sentences.at(place); !sentence.empty()) text += ": " + sentence;
  std::string notes;
  for (std::size_t i = 0; i < identify_note_names.size(); ++i) {
    const bool said = identify_note_names.at(i) == mode_result_names.at(place);
    if (said || (snapshot.identify_notes >> i & 1U) == 0) continue;
    notes += notes.empty() ? "; " : ", ";
    notes += identify_note_names.at(i);
  }
  return text + notes + " (docs/running.md#commands)";
}

std::string mode_failed_because(const Scenario& scenario, const Simulation& simulation) {
  const bool asked =
      asks_for_mode(scenario.start) || std::ranges::any_of(scenario.events, [](const Event& event) {
        return asks_for_mode(event.conditions);
      });
  const Snapshot& snapshot = simulation.loop().channel(0).snapshot();
  const bool found =
      snapshot.result == ModeResult::found || snapshot.result == ModeResult::not_stored;
  return asked && !found ? describe_mode(snapshot) : std::string();
}

}  // namespace supercoil::host_sim
