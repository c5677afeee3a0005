#include "loop/tuner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supercoil {

namespace {

/// More than a master requests before it has its answers.
constexpr std::size_t max_built = 8;

constexpr std::size_t no_place = std::numeric_limits<std::size_t>::max();

std::size_t place_of(double value) {
  const bool possible = value >= 0.0 && value < 256.0;  // false for NaN
  return possible ? static_cast<std::size_t>(value) : no_place;
}

}  // namespace

template <class Settings>
std::vector<Tuner::Place<Settings>> Tuner::Place<Settings>::all_of(
    const std::vector<Settings>& in_use, const std::vector<Settings>& configured,
    std::size_t at_most) {
  std::vector<Place> all;
  for (std::size_t i = 0; i < std::min(in_use.size(), at_most); ++i)
    all.push_back({configured.empty() ? in_use[i] : configured[i], in_use[i], in_use[i]});
  return all;
}

template <class Settings>
Settings Tuner::Place<Settings>::of(TuningSet set, const board::StoredValues& stored) const {
  if (set == TuningSet::prepared) return prepared;
  if (set == TuningSet::in_use) return in_use;
  Settings settings = configured;
  if (set == TuningSet::stored) stored.apply_to(settings);
  return settings;
}

Tuner::Tuner(const ChannelSettings& channel, double step_s)
    : channel_(channel),
      step_s_(step_s),
      stored_(channel.tuning),
      controllers_(Place<control::ControllerSettings>::all_of(
          channel.controllers, channel.configured_controllers, stored_.controllers.size())),
      estimators_(Place<control::EstimatorSettings>::all_of(
          channel.estimators, channel.configured_estimators, stored_.estimators.size())) {}

template <class Self, class Function>
bool Tuner::at(Self& self, std::size_t place, Function function) {
  if (place < self.controllers_.size()) {
    function(self.controllers_[place], self.stored_.controllers[place]);
    return true;
  }
  const std::size_t estimator = place - first_estimator_place;
  if (place < first_estimator_place || estimator >= self.estimators_.size()) return false;
  function(self.estimators_[estimator], self.stored_.estimators[estimator]);
  return true;
}

double Tuner::value(TuningSet set, std::size_t place, std::size_t parameter) const {
  double found = NAN;
  if (parameter >= control::tunable_count || set > TuningSet::stored) return found;
  at(*this, place, [&](const auto& found_place, const board::StoredValues& stored) {
    found = control::tunables()[parameter].get(found_place.of(set, stored));
  });
  return found;
}

Reply Tuner::prepare(std::size_t place, std::size_t parameter, double value) {
  if (std::isnan(this->value(TuningSet::prepared, place, parameter))) return Refusal::out_of_range;
  const control::Tunable& tunable = control::tunables()[parameter];
  if (!tunable.in_range(value))
    return {Refusal::out_of_range, std::clamp(value, tunable.min, tunable.max)};
  at(*this, place, [&](auto& found, const auto&) { tunable.set(found.prepared, value); });
  return Refusal::none;
}

bool Tuner::prepare_from(TuningSet set, std::size_t place) {
  return set <= TuningSet::stored &&
         at(*this, place, [&](auto& found, const board::StoredValues& stored) {
           found.prepared = found.of(set, stored);
         });
}

board::StoredTuning Tuner::tuning_in_use() const {
  board::StoredTuning tuning;
  const auto differences = [](const auto& places, auto& stored) {
    for (std::size_t i = 0; i < places.size(); ++i)
      stored[i] = board::StoredValues::difference(places[i].in_use, places[i].configured);
  };
  differences(controllers_, tuning.controllers);
  differences(estimators_, tuning.estimators);
  return tuning;
}

void Tuner::add_to(Command& command, const control::PhysicalParameters& muscle) {
  if (command.verb != Verb::store && command.verb != Verb::tune) return;
  command.tuned_controller = nullptr;
  command.tuned_estimator = nullptr;
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
  channel_.muscle = muscle;
  build(place_of(command.value), command);
}

template <class Settings>
bool Tuner::passes_check(const Settings& wanted) {
  const auto problem = check(wanted, channel_, step_s_);
  if (problem) problem_ = problem->key + " " + problem->message;
  return !problem;
}

void Tuner::build(std::size_t place, Command& command) {
  if (place < controllers_.size()) {
    const control::ControllerSettings& wanted = controllers_[place].prepared;
    if (built_controllers_.size() == max_built || !passes_check(wanted)) return;
    using One = Built<control::ControllerSettings, control::Controller>;
    built_controllers_.push_back(
        std::make_unique<One>(One{place, wanted, control::Controller(wanted, step_s_)}));
    command.tuned_controller = &built_controllers_.back()->running;
    return;
  }
  const std::size_t estimator = place - first_estimator_place;
  if (place < first_estimator_place || estimator >= estimators_.size()) return;
  const control::EstimatorSettings& wanted = estimators_[estimator].prepared;
  if (built_estimators_.size() == max_built || !passes_check(wanted)) return;
  control::EstimatorSettings begins = wanted;
  begins.begin_at(channel_.muscle);
  using One = Built<control::EstimatorSettings, control::Estimator>;
  built_estimators_.push_back(
      std::make_unique<One>(One{estimator, wanted, control::Estimator(begins, step_s_)}));
  command.tuned_estimator = &built_estimators_.back()->running;
}

template <class Settings, class Running>
void Tuner::conclude(AllBuilt<Settings, Running>& built, std::vector<Place<Settings>>& places,
                     const Running* tuned, bool taken) {
  const auto found =
      std::ranges::find_if(built, [&](const auto& one) { return &one->running == tuned; });
  if (tuned == nullptr || found == built.end()) return;
  if (taken) places[(*found)->place].in_use = (*found)->settings;
  built.erase(found);
}

void Tuner::conclude(const Answer& answer) {
  const Command& command = answer.command;
  const bool taken = answer.refusal == Refusal::none;
  if (command.tuning != nullptr) {
    storing_ = false;
    if (taken) stored_ = to_store_;
  }
  conclude(built_controllers_, controllers_, command.tuned_controller, taken);
  conclude(built_estimators_, estimators_, command.tuned_estimator, taken);
}

}  // namespace supercoil
