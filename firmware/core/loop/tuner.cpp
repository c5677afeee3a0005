#include "loop/tuner.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil {

namespace {

/// More than a master asks for before it has its answers.
constexpr std::size_t max_built = 8;

}  // namespace

Tuner::Tuner(const ChannelSettings& channel, double step_s)
    : channel_(channel), step_s_(step_s), stored_(channel.tuning) {
  const std::size_t places = std::min(channel.controllers.size(), stored_.controllers.size());
  const auto& configured =
      channel.configured_controllers.empty() ? channel.controllers : channel.configured_controllers;
  for (std::size_t i = 0; i < places; ++i)
    places_.push_back({configured[i], channel.controllers[i], channel.controllers[i]});
}

const control::ControllerSettings* Tuner::settings_of(TuningSet set, std::size_t place) const {
  if (place >= places_.size()) return nullptr;
  switch (set) {
    case TuningSet::prepared:
      return &places_[place].prepared;
    case TuningSet::in_use:
      return &places_[place].in_use;
    case TuningSet::configured:
      return &places_[place].configured;
    case TuningSet::stored:
      break;
  }
  return nullptr;
}

control::ControllerSettings Tuner::stored(std::size_t place) const {
  control::ControllerSettings settings = places_[place].configured;
  stored_.controllers[place].apply_to(settings);
  return settings;
}

double Tuner::value(TuningSet set, std::size_t place, std::size_t parameter) const {
  if (place >= places_.size() || parameter >= control::tunable_count) return NAN;
  const control::Tunable& tunable = control::tunables()[parameter];
  if (set == TuningSet::stored) return tunable.get(stored(place));
  const control::ControllerSettings* settings = settings_of(set, place);
  return settings == nullptr ? NAN : tunable.get(*settings);
}

Reply Tuner::prepare(std::size_t place, std::size_t parameter, double value) {
  if (std::isnan(this->value(TuningSet::prepared, place, parameter))) return Refusal::out_of_range;
  const control::Tunable& tunable = control::tunables()[parameter];
  if (!tunable.in_range(value))
    return {Refusal::out_of_range, std::clamp(value, tunable.lowest, tunable.highest)};
  tunable.set(places_[place].prepared, value);
  return Refusal::none;
}

bool Tuner::prepare_from(TuningSet set, std::size_t place) {
  if (place >= places_.size() || set > TuningSet::stored) return false;
  places_[place].prepared = set == TuningSet::stored ? stored(place) : *settings_of(set, place);
  return true;
}

board::StoredTuning Tuner::tuning_in_use() const {
  board::StoredTuning tuning;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    tuning.controllers[i] =
        board::TunedController::difference(places_[i].in_use, places_[i].configured);
  }
  return tuning;
}

void Tuner::add_to(Command& command, const control::PhysicalParameters& muscle) {
  command.tuned = nullptr;
  command.tuning = nullptr;
  if (command.verb == Verb::store && !storing_) {
    if (command.value == store_tuning) to_store_ = tuning_in_use();
    if (command.value == clear_tuning) to_store_ = {};
    if (command.value != store_tuning && command.value != clear_tuning) return;
    storing_ = true;
    command.tuning = &to_store_;
  }
  if (command.verb != Verb::tune) return;
  problem_.clear();
  // A NaN is no place either.
  const bool known = command.value >= 0.0 && command.value < static_cast<double>(places_.size());
  if (!known || built_.size() == max_built) return;
  const auto place = static_cast<std::size_t>(command.value);
  channel_.muscle = muscle;
  const control::ControllerSettings& wanted = places_[place].prepared;
  if (const auto problem = check(wanted, channel_, step_s_)) {
    problem_ = problem->key + " " + problem->message;
    return;
  }
  built_.push_back(
      std::make_unique<Built>(Built{place, wanted, control::Controller(wanted, step_s_)}));
  command.tuned = &built_.back()->controller;
}

void Tuner::conclude(const Answer& answer) {
  const Command& command = answer.command;
  if (command.tuning != nullptr) {
    storing_ = false;
    if (answer.refusal == Refusal::none) stored_ = to_store_;
  }
  if (command.tuned == nullptr) return;
  const auto built = std::ranges::find_if(
      built_, [&](const auto& one) { return &one->controller == command.tuned; });
  if (built == built_.end()) return;
  if (answer.refusal == Refusal::none) places_[(*built)->place].in_use = (*built)->settings;
  built_.erase(built);
}

}  // namespace supercoil
