// supercoil doctor --compare-senses: compares a running board's senses with a meter.
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/setup/running_file.hpp"
#include "apps/supercoil/setup/sense_comparison.hpp"
#include "apps/supercoil/setup/terminal_operator.hpp"
#include "config/board_config.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

/// Address of the file's first channel: over CAN it is a node.
int first_address(const DoctorOptions& options, const config::BoardConfig& config) {
  return options.can.empty() || !config.can ? 1 : config.can->first_node;
}

/// Which channel of the file is meant. 0: none.
std::size_t channel_of(const DoctorOptions& options, const config::BoardConfig& config) {
  const int index = options.channel - first_address(options, config);
  const auto known = static_cast<int>(config.settings.channels.size());
  return index >= 0 && index < known ? static_cast<std::size_t>(index) + 1 : 0;
}

/// The safe power follows from the file, so the board must run with it. Empty: it does.
std::string board_differences(BoardLink& board, const DoctorOptions& options,
                              const config::BoardConfig& config, std::size_t place) {
  const auto differences =
      differences_of_board(board, first_address(options, config), config.settings, place - 1);
  if (!differences) return differences.error().text();
  if (differences->empty()) return {};
  return options.config + ": the board is not running with this file: " + *differences +
         "; start the board with it, or name the file it runs with: --config FILE";
}

int report_result(const Result<board::SenseComparison>& found, const ComparisonPlan& plan,
                  bool json, const std::string& bounds) {
  if (json) {
    nlohmann::ordered_json report{{"channel", std::stoi(plan.channel)}, {"power_W", plan.power_W}};
    if (found) {
      report["supply_gain"] = found->supply_gain;
      report["current_gain"] = found->current_gain;
      report["error_ratio"] = found->error_ratio;
      report["bounds"] = bounds;
    } else {
      report["error"] = found.error().text();
    }
    std::printf("%s\n", report.dump(2).c_str());
  }
  if (!found) return fail(exit_failed, found.error().text());
  if (!json) {
    std::printf("%s\n%s\n", describe_comparison(*found).c_str(), bounds.c_str());
  }
  return exit_done;
}

}  // namespace

int compare_senses(const DoctorOptions& options) {
  const auto config = config::read_board_config(options.config);
  if (!config && options.power_W <= 0.0) {
    const std::string problems = config::to_text(config.error());
    if (options.json) print_error(problems.substr(0, problems.find_last_not_of('\n') + 1));
    std::fputs(problems.c_str(), stderr);
    return exit_wrong_input;
  }
  const std::size_t place = config ? channel_of(options, *config) : 0;
  if (config && place == 0) {
    return refuse(options.json, exit_wrong_input,
                  options.config + " has no channel " + std::to_string(options.channel));
  }
  ComparisonPlan plan{std::to_string(options.channel)};
  if (config) {
    const BoardSettings& board = config->settings;
    plan = plan_comparison(plan.channel, board.channels[place - 1], board);
  }
  const double max_W = config ? config->settings.channels[place - 1].limiter.max_W : INFINITY;
  if (options.power_W > max_W) {
    return refuse(options.json, exit_wrong_input,
                  "--power " + number_text(options.power_W, 3) + ": " + options.config +
                      " allows channel " + plan.channel + " at most " + number_text(max_W, 3) +
                      " W (limits.max_W)");
  }
  if (options.power_W > 0.0) plan.power_W = options.power_W;
  watch_for_interrupts();
  const auto board = open_link(options.can, options.socket);
  if (!board) return refuse(options.json, exit_failed, board.error().text());
  if (config) {
    if (const std::string why = board_differences(**board, options, *config, place); !why.empty())
      return refuse(options.json, exit_failed, why);
  }
  std::FILE* out = options.json ? stderr : stdout;
  std::fprintf(out,
               "Compares the senses of channel %s with a meter. Arms the channel, heats it with "
               "%s W and then %s W, and asks two questions at each power, with at most 5 minutes "
               "for each answer; then it is cold again. Ctrl-C ends it at any time.\n",
               plan.channel.c_str(), number_text(0.5 * plan.power_W, 3).c_str(),
               number_text(plan.power_W, 3).c_str());
  std::fflush(out);
  TerminalOperator terminal(out);
  const auto found = compare_senses(**board, plan, terminal);
  std::string bounds;
  if (found && config)
    bounds = power_bounds_text(config->settings.channels[place - 1], config->settings, *found);
  return report_result(found, plan, options.json, bounds);
}

}  // namespace supercoil::operating
