// supercoil setup: from a muscle that somebody has to one that follows.
#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/setup/commission.hpp"
#include "apps/supercoil/setup/describe_step.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/setup/steps.hpp"
#include "config/board_config.hpp"
#include "text/nearest.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> step_names() {
  std::vector<std::string> names(setup_steps.size());
  std::ranges::transform(setup_steps, names.begin(), &SetupStep::name);
  return names;
}

bool wanted(const SetupStep& step, const SetupOptions& options, const SetupRecord& record) {
  const std::string name(step.name);
  if (options.steps.empty()) return !record.has(name);
  return std::ranges::find(options.steps, name) != options.steps.end();
}

/// The steps that need a running board, one after the other.
class Board {
 public:
  Board(const SetupOptions& options, std::FILE* out) : options_(options), out_(out) {}
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  /// However it ends, the muscle gets no power.
  ~Board() {
    if (link_) static_cast<void>(link_->ask(address() + " disarm"));
  }

  StepResult run(const std::string& step) {
    if (auto ready = open(); !ready) return tl::unexpected(ready.error());
    const auto index = static_cast<std::size_t>(options_.channel) - 1;
    Commission commission(*link_, address(), config_->settings.channels[index], config_->settings,
                          [this](const std::string& line) {
                            std::fprintf(out_, "  %s\n", line.c_str());
                            std::fflush(out_);
                          });
    if (step == "calibrate") return commission.calibrate();
    return step == "identify" ? commission.identify() : commission.move();
  }

 private:
  tl::expected<void, std::string> open() {
    if (link_) return {};
    auto config = config::read_board_config(options_.config);
    if (!config) return tl::unexpected(config::to_text(config.error()));
    const auto channels = static_cast<int>(config->settings.channels.size());
    if (options_.channel > channels) {
      return tl::unexpected(options_.config + " has no channel " +
                            std::to_string(options_.channel) + ", but " + std::to_string(channels));
    }
    auto link = open_link(options_.can, options_.socket);
    if (!link) {
      return tl::unexpected(link.error() + "; start the board with " + options_.config +
                            " first (supercoild --config, or supercoil-sim run bench --board)");
    }
    config_ = std::move(*config);
    link_ = std::move(*link);
    return {};
  }

  /// On a bus channels are nodes.
  std::string address() const {
    const int first = options_.can.empty() || !config_->can ? 1 : config_->can->first_node;
    return std::to_string(first + options_.channel - 1);
  }

  const SetupOptions& options_;
  std::FILE* out_;
  std::optional<config::BoardConfig> config_;
  std::unique_ptr<BoardLink> link_;
};

int concluded(const SetupOptions& options, const Json& results, int status,
              const std::string& error) {
  if (options.json) {
    Json told{{"steps", results}};
    if (!error.empty()) told["error"] = error;
    std::printf("%s\n", told.dump(2).c_str());
  }
  return error.empty() ? status : fail(status, error);
}

int run_steps(const SetupOptions& options, SetupRecord& record, std::FILE* out) {
  Board board(options, out);
  Json results = Json::object();
  int status = exit_done;
  for (const SetupStep& step : setup_steps) {
    if (!wanted(step, options, record)) continue;
    const std::string name(step.name);
    std::fprintf(out, "%s: %s\n", name.c_str(), std::string(step.does).c_str());
    std::fflush(out);
    const bool describes = name == "describe";
    const StepResult found = describes ? describe_step(options, out) : board.run(name);
    if (!found) {
      const int why = describes ? exit_wrong_input : exit_failed;
      if (!describes) return concluded(options, results, why, name + ": " + found.error());
      std::string lines = found.error();
      if (!lines.empty() && lines.back() == '\n') lines.pop_back();
      return concluded(options, results, why, lines);
    }
    results[name] = *found;
    if (auto kept = record.add(name, *found); !kept)
      return concluded(options, results, exit_failed, kept.error());
    if (!Commission::kept(*found)) status = exit_failed;
    // The board must run with the file as it is now.
    if (describes && options.steps.empty()) {
      std::fprintf(out, "%s is complete: start the board with it, and run setup again to go on\n",
                   options.config.c_str());
      break;
    }
  }
  if (results.empty()) std::fprintf(out, "every step is done; name one to do it again\n");
  return concluded(options, results, status, "");
}

}  // namespace

void add_setup(CLI::App& app, SetupOptions& o) {
  CLI::App* setup = app.add_subcommand(
      "setup",
      "From a muscle of your own to one that follows, step by step: describe it in a bench's "
      "units, calibrate, identify, move. What is done is remembered beside the board's file");
  setup
      ->add_option("STEP", o.steps,
                   "describe, calibrate, identify or move, also again [all that are not done]")
      ->check(CLI::Validator(
          [](const std::string& given) {
            const auto names = step_names();
            return std::ranges::find(names, given) != names.end()
                       ? std::string()
                       : given + ": " + meant_or_all(given, names, "the steps are");
          },
          ""));
  setup->add_option("--config", o.config, "The board's configuration, which is completed")
      ->type_name("FILE")
      ->capture_default_str();
  setup->add_option("--channel", o.channel, "Of that file, from 1")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  setup
      ->add_option("--script", o.script,
                   "Answers in a TOML file's table [muscle]; then nothing is asked")
      ->type_name("FILE");
  CLI::Option* socket =
      setup->add_option("--socket", o.socket, "Where supercoild listens")->capture_default_str();
  setup
      ->add_option("--can", o.can,
                   "The board is on this bus: can0, or socketcand:[HOST:]PORT[/INTERFACE]")
      ->type_name("BUS")
      ->excludes(socket);
  setup->add_flag("--undo", o.undo,
                  "Put the file back as it was before setup, and forget what was done");
  setup->add_flag("--json", o.json, "Print what was found as one JSON object");
}

int setup_command(const SetupOptions& options) {
  if (options.undo) {
    const auto undone = undo_setup(options);
    return undone ? exit_done : fail(exit_failed, undone.error());
  }
  watch_for_interrupts();
  auto record = SetupRecord::open(options.config, options.channel);
  if (!record) return fail(exit_failed, record.error());
  return run_steps(options, *record, options.json ? stderr : stdout);
}

}  // namespace supercoil::operating
