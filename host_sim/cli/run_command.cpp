#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "apps/common/problems_json.hpp"
#include "cli/commands.hpp"
#include "cli/forecast.hpp"
#include "cli/learned_folder.hpp"
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

using Problems = std::vector<config::Problem>;
using OrProblems = tl::expected<void, Problems>;

/// With an option, or what it names.
Problems wrong_option(const std::string& option, const std::string& value,
                      const std::string& message) {
  return {{"", 0, option, message, value}};
}

/// As every command says it, or with --json for programs.
int refuse(const RunOptions& options, const Problems& problems) {
  if (options.json) {
    std::puts(problems_json(problems).dump(2).c_str());
    return exit_wrong_input;
  }
  for (const config::Problem& problem : problems) {
    const bool of_option = problem.file.empty();
    const std::string value = problem.value.empty() ? "" : " " + problem.value;
    const std::string what = problem.key + value + ": " + problem.message;
    std::fprintf(stderr, "%s\n",
                 of_option ? ("supercoil-sim: " + what).c_str() : problem.text().c_str());
  }
  return exit_wrong_input;
}

/// Of --board, if there is one.
OrProblems use_own_board(const RunOptions& options, const LearnedMuscles& learned,
                         Scenario& scenario) {
  if (options.board.empty()) return {};
  const auto config = config::read_board_config(options.board);
  if (!config) return tl::unexpected(config.error());
  const auto channels = static_cast<int>(config->settings.channels.size());
  if (options.channel > channels) {
    return tl::unexpected(wrong_option("--channel", std::to_string(options.channel),
                                       options.board + " has " + std::to_string(channels)));
  }
  const auto used =
      use_board(scenario, *config, static_cast<std::size_t>(options.channel) - 1, learned);
  if (used) return {};
  return tl::unexpected(Problems{{options.scenario + " on " + options.board, 0, "", used.error()}});
}

/// The scenario with the board that the options want.
tl::expected<Scenario, Problems> read_input(const RunOptions& options,
                                            LearnedFolder& folder_of_learned) {
  const auto learned = folder_of_learned.load();
  if (!learned) return tl::unexpected(wrong_option("--learned", "", learned.error()));
  auto scenario = read_scenario(options.scenario, *learned);
  if (!scenario) return scenario;
  if (auto used = use_own_board(options, *learned, *scenario); !used)
    return tl::unexpected(std::move(used.error()));
  return scenario;
}

tl::expected<Window, Problems> window_of(const RunOptions& options, const Scenario& scenario) {
  const auto window = read_window(options.window, scenario.duration_s, scenario.step_s());
  if (window) return *window;
  return tl::unexpected(wrong_option("--window", options.window,
                                     "must be FROM:TO in seconds, a tick or more within 0 to " +
                                         number_text(scenario.duration_s, 9)));
}

OrProblems check_nodes(const RunOptions& options, const Scenario& scenario) {
  const int most = (can::max_nodes + 1 - scenario.can.first_node) / scenario.channels();
  if (options.nodes <= most) return {};
  return tl::unexpected(wrong_option("--nodes", std::to_string(options.nodes),
                                     "must be 1 to " + std::to_string(most) +
                                         ", as the first is node " +
                                         std::to_string(int{scenario.can.first_node})));
}

}  // namespace

int run_command(const RunOptions& given) {
  RunOptions options = given;
  options.quiet = options.quiet || options.json;
  LearnedFolder folder_of_learned(options.learned);
  const auto scenario = read_input(options, folder_of_learned);
  if (!scenario) return refuse(options, scenario.error());
  const auto window = window_of(options, *scenario);
  if (!window) return refuse(options, window.error());
  if (const auto checked = check_nodes(options, *scenario); !checked)
    return refuse(options, checked.error());
  if (options.check && options.json) {
    std::puts(forecast_json(*scenario).dump(2).c_str());
    return exit_done;
  }
  if (options.check) {
    std::printf("%s: in order, %" PRId64 " ticks, %zu events\n", options.scenario.c_str(),
                scenario->ticks(), scenario->events.size());
    print_forecast(*scenario);
    return exit_done;
  }
  auto folder =
      OutputFolder::open(options.out.empty() ? "supercoil-out/" + scenario->name : options.out);
  if (!folder) return fail(exit_wrong_input, folder.error());

  if (options.real_time) return live_run(options, *scenario, *window, *folder, folder_of_learned);
  if (!options.quiet) print_forecast(*scenario);
  return lockstep_run(options, *scenario, *window, *folder, folder_of_learned);
}

}  // namespace supercoil::host_sim
