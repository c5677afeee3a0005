#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "apps/common/keys_json.hpp"
#include "apps/common/problems_json.hpp"
#include "cli/commands.hpp"
#include "cli/forecast.hpp"
#include "cli/learned_folder.hpp"
#include "cli/one_bus.hpp"
#include "cli/results_json.hpp"
#include "cli/runs.hpp"
#include "config/board_config.hpp"
#include "report/output_folder.hpp"
#include "runner/summary.hpp"
#include "runner/use_board.hpp"
#include "scenario/read_scenario.hpp"
#include "text/number_text.hpp"

namespace supercoil::host_sim {

namespace {

std::optional<double> read_seconds(std::string_view text, double fallback) {
  if (text.empty()) return fallback;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "FROM:TO", "FROM:" or ":TO" within the run; empty text is the whole of it.
std::optional<Window> read_window(const std::string& text, double duration_s, double step_s) {
  if (text.empty()) return Window{0.0, duration_s};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const auto from = read_seconds(std::string_view(text).substr(0, colon), 0.0);
  const auto to = read_seconds(std::string_view(text).substr(colon + 1), duration_s);
  if (!from || !to || !(*from >= 0.0 && *from + step_s <= *to && *to <= duration_s))
    return std::nullopt;
  return Window{*from, *to};
}

using OrErrors = tl::expected<void, Errors>;

/// A problem with an option, or with what it names.
Errors wrong_option(const std::string& option, const std::string& value,
                    const std::string& message) {
  return {{"", 0, option, message, value}};
}

/// Reports as every command does, or as JSON with --json.
int refuse(const RunOptions& options, const Errors& problems) {
  if (options.json) {
    std::puts(problems_json(problems).dump(2).c_str());
    return exit_wrong_input;
  }
  for (const Error& problem : problems) {
    const bool of_option = problem.file.empty();
    const std::string value = problem.value.empty() ? "" : " " + problem.value;
    const std::string what = problem.key + value + ": " + problem.message;
    std::fprintf(stderr, "%s\n",
                 of_option ? ("supercoil-sim: " + what).c_str() : problem.text().c_str());
  }
  return exit_wrong_input;
}

/// Applies --board, if there is one for this scenario.
OrErrors use_own_board(const RunOptions& options, std::size_t place, const LearnedMuscles& learned,
                       Scenario& scenario) {
  if (options.boards.empty()) return {};
  const std::string& board = options.boards[place];
  const auto config = config::read_board_config(board);
  if (!config) return tl::unexpected(config.error());
  const auto channels = static_cast<int>(config->settings.channels.size());
  const int channel = place < options.channels.size() ? options.channels[place] : 1;
  if (channel > channels) {
    return tl::unexpected(
        wrong_option("--channel", std::to_string(channel),
                     "must be 1 to " + std::to_string(channels) + ", the channels of " + board));
  }
  const auto used = use_board(scenario, *config, static_cast<std::size_t>(channel) - 1, learned);
  if (used) return {};
  return tl::unexpected(
      Errors{{options.scenarios[place] + " on " + board, 0, "", used.error().text()}});
}

/// Checks that the options go together, before any file is read.
OrErrors check_together(const RunOptions& options) {
  const std::size_t scenarios = options.scenarios.size();
  const std::string of_scenarios = std::to_string(scenarios) + " scenarios";
  if (scenarios > 1 && options.nodes > 1) {
    return tl::unexpected(wrong_option("--nodes", std::to_string(options.nodes),
                                       "applies to one scenario, but there are " + of_scenarios));
  }
  if (scenarios > 1 && !options.learned.empty()) {
    return tl::unexpected(wrong_option("--learned", options.learned,
                                       "applies to one board, but there are " + of_scenarios));
  }
  const auto once_for_each = [&](const char* option, std::size_t given) -> OrErrors {
    if (given <= scenarios) return {};
    return tl::unexpected(wrong_option(
        option, "",
        "is given " + std::to_string(given) + " times: give it at most once for each SCENARIO"));
  };
  if (const std::size_t given = options.boards.size(); given > 0 && given < scenarios) {
    return tl::unexpected(wrong_option("--board", options.boards.back(),
                                       "is given " + std::to_string(given) + " times for " +
                                           of_scenarios +
                                           ": give it once for each, or not at all"));
  }
  if (auto board = once_for_each("--board", options.boards.size()); !board) return board;
  return once_for_each("--channel", options.channels.size());
}

/// The scenarios on one bus, with the boards that the options name. keys: of each.
tl::expected<std::vector<Scenario>, Errors> read_input(const RunOptions& options,
                                                       LearnedFolder& folder_of_learned,
                                                       std::vector<config::KeyList>& keys) {
  if (auto together = check_together(options); !together)
    return tl::unexpected(std::move(together.error()));
  const auto learned = folder_of_learned.load();
  if (!learned) return tl::unexpected(wrong_option("--learned", "", learned.error().text()));
  std::vector<Scenario> scenarios;
  for (std::size_t i = 0; i < options.scenarios.size(); ++i) {
    const Hardware hardware = options.boards.empty() ? Hardware::scenarios : Hardware::boards;
    keys.emplace_back();
    auto scenario = read_scenario(options.scenarios[i], *learned, hardware, &keys.back());
    if (!scenario) return tl::unexpected(std::move(scenario.error()));
    if (auto used = use_own_board(options, i, *learned, *scenario); !used)
      return tl::unexpected(std::move(used.error()));
    scenarios.push_back(std::move(*scenario));
  }
  return on_one_bus(options, std::move(scenarios));
}

tl::expected<Window, Errors> window_of(const RunOptions& options, const Scenario& scenario) {
  const auto window = read_window(options.window, scenario.duration_s, scenario.step_s());
  if (window) return *window;
  return tl::unexpected(
      wrong_option("--window", options.window,
                   "must be FROM:TO in seconds, at least one tick long and within 0 to " +
                       number_text(scenario.duration_s, 9)));
}

/// JSON of several scenarios is a list.
void print(const nlohmann::ordered_json& of_each) {
  std::puts((of_each.size() == 1 ? of_each[0] : of_each).dump(2).c_str());
}

void print_keys(const RunOptions& options, const std::vector<config::KeyList>& keys) {
  if (options.json) {
    nlohmann::ordered_json all;
    for (const config::KeyList& of_scenario : keys)
      all.push_back(keys_json(of_scenario));
    return print(all);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys.size() > 1) std::printf("%s:\n", options.scenarios[i].c_str());
    std::fputs(config::to_text(keys[i]).c_str(), stdout);
  }
}

/// Checks one of several copies, since all can do the same.
void check_only(const RunOptions& options, const std::vector<Scenario>& boards) {
  const std::size_t scenarios = options.scenarios.size();
  if (options.json) {
    nlohmann::ordered_json all;
    for (std::size_t i = 0; i < scenarios; ++i)
      all.push_back(forecast_json(boards[i]));
    return print(all);
  }
  for (std::size_t i = 0; i < scenarios; ++i) {
    std::printf("%s: in order, %" PRId64 " ticks, %zu events\n", options.scenarios[i].c_str(),
                boards[i].ticks(), boards[i].events.size());
    print_forecast(boards[i]);
  }
}

}  // namespace

std::string name_of(const std::vector<Scenario>& boards) {
  std::string name = boards.front().name;
  for (std::size_t i = 1; i < boards.size(); ++i) {
    if (boards[i].name != boards[i - 1].name) name += "+" + boards[i].name;
  }
  return name;
}

int run_command(const RunOptions& given) {
  RunOptions options = given;
  options.quiet = options.quiet || options.json;
  LearnedFolder folder_of_learned(options.learned);
  std::vector<config::KeyList> keys;
  const auto boards = read_input(options, folder_of_learned, keys);
  if (!boards) return refuse(options, boards.error());
  const auto window = window_of(options, boards->front());
  if (!window) return refuse(options, window.error());
  if (options.keys) {
    print_keys(options, keys);
    return exit_done;
  }
  if (options.check) {
    check_only(options, *boards);
    return exit_done;
  }
  auto folder =
      OutputFolder::open(options.out.empty() ? "supercoil-out/" + name_of(*boards) : options.out);
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());

  if (options.real_time) return live_run(options, *boards, *window, *folder, folder_of_learned);
  for (std::size_t i = 0; !options.quiet && i < options.scenarios.size(); ++i) {
    if (options.scenarios.size() > 1) std::printf("%s:\n", name_on_bus((*boards)[i]).c_str());
    print_forecast((*boards)[i]);
  }
  return lockstep_run(options, *boards, *window, *folder, folder_of_learned);
}

}  // namespace supercoil::host_sim
