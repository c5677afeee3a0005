// supercoil tune: reads, changes and stores values of controllers and estimators on a running
// board.
#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/change_tuning.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/tuned_place.hpp"
#include "apps/supercoil/tuning_table.hpp"
#include "telemetry/run_settings.hpp"
#include "text/nearest.hpp"

namespace supercoil::operating {

namespace {

using control::Tunable;

/// The error for a name that cannot be tuned; suggests what was meant, also of another command.
std::string not_tunable(const std::string& name, const std::string& value,
                        const std::vector<std::string>& known, const TuneOptions& options) {
  std::uint8_t setting = 0;
  while (setting < telemetry::run_settings && telemetry::run_setting_name(setting) != name)
    ++setting;
  if (setting < telemetry::run_settings) {
    return name + " is a setting, which tune does not change: supercoil setting " +
           std::to_string(options.channel) + " " + name + (value.empty() ? "" : " " + value) +
           " --can " + (options.can.empty() ? "BUS" : options.can);
  }
  return name + " cannot be tuned; " + suggestion_or_all(name, known, "there are");
}

Result<std::vector<TuningChange>> parse(Tuned what, const TuneOptions& options) {
  const std::vector<std::string> known = tunable_names(what);
  std::vector<TuningChange> all;
  for (const std::string& word : options.assignments) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const std::string text = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (name.empty()) return failure(word + ": write NAME=VALUE");
    if (std::ranges::find(known, name) == known.end())
      return failure(not_tunable(name, text, known, options));
    if (equals == std::string::npos) return failure(word + ": write NAME=VALUE");
    const std::size_t tunable = control::tunable_named(name);
    const auto value = tuning_value(what, control::tunables()[tunable], text);
    if (!value) return tl::unexpected(value.error());
    all.push_back({tunable, *value});
  }
  // The available values depend on the kind, and the poles on the model: as in tunables().
  std::ranges::stable_sort(all, {}, &TuningChange::tunable);
  return all;
}

void print(Tuned what, std::size_t place, const TunedValues& all) {
  const Tunable& kind = control::tunables()[0];
  const auto in_use = static_cast<std::size_t>(TuningSet::in_use);
  std::printf("%s %zu: %s\n", name(what).data(), place,
              tuning_text(what, kind, all.at(0)[in_use]).c_str());
  std::printf("  %-28s %12s %12s %12s %12s\n", "", "in use", "configured", "stored", "prepared");
  for (const auto& one : all) {
    const Tunable& t = control::tunables()[one.first];
    const auto text = [&](TuningSet set) {
      return tuning_text(what, t, one.second[static_cast<std::size_t>(set)]);
    };
    const std::string configured = text(TuningSet::configured);
    const bool differs =
        text(TuningSet::in_use) != configured || text(TuningSet::stored) != configured;
    std::printf("%c %-28s %12s %12s %12s %12s\n", differs ? '*' : ' ', t.name.data(),
                text(TuningSet::in_use).c_str(), configured.c_str(),
                text(TuningSet::stored).c_str(), text(TuningSet::prepared).c_str());
  }
}

/// All controllers and estimators.
TuningDone print_tuning(BoardLink& board, const std::string& channel, bool json) {
  const auto tuning = read_tuning(tunable_reader(board, channel));
  if (!tuning) return tl::unexpected(tuning.error());
  if (json) {
    std::printf("%s\n", tuning_json(*tuning).dump().c_str());
    return {};
  }
  for (std::size_t i = 0; i < tuning->controllers.size(); ++i)
    print(Tuned::controller, i, tuning->controllers[i]);
  for (std::size_t i = 0; i < tuning->estimators.size(); ++i)
    print(Tuned::estimator, i, tuning->estimators[i]);
  return {};
}

}  // namespace

int tune_command(const TuneOptions& options) {
  const Tuned what = options.estimator ? Tuned::estimator : Tuned::controller;
  const auto changes = parse(what, options);
  if (!changes) return refuse(options.json, exit_wrong_input, changes.error().text());
  const auto board = open_link(options.can, options.socket);
  if (!board) return refuse(options.json, exit_failed, board.error().text());
  const std::string channel = std::to_string(options.channel);
  const auto found = find_place(what, options.estimator.value_or(options.controller),
                                tunable_reader(**board, channel));
  if (!found) return refuse(options.json, exit_for(found.error()), found.error().text());
  const int place = place_of(what, *found);
  TuningDone done;
  if (!changes->empty() || options.from != "in_use") {
    done = prepare_tuning(**board, channel, place, options.from, *changes);
    if (done && !options.only_prepare)
      done = send_tuning_command(**board, channel + " tune " + std::to_string(place));
  }
  if (done && options.store) done = send_tuning_command(**board, channel + " store tuning");
  if (done && options.clear) done = send_tuning_command(**board, channel + " clear tuning");
  if (done) done = print_tuning(**board, channel, options.json);
  return done ? exit_done : refuse(options.json, exit_failed, done.error().text());
}

}  // namespace supercoil::operating
