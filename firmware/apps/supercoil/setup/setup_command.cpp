// supercoil setup: commissions a muscle until it follows a reference.
#include <algorithm>
#include <cstdio>
#include <optional>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/setup/board_file.hpp"
#include "apps/supercoil/setup/file_steps.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/setup/script.hpp"
#include "apps/supercoil/setup/setup_board.hpp"
#include "apps/supercoil/setup/steps.hpp"
#include "apps/supercoil/setup/terminal_operator.hpp"
#include "text/nearest.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

/// Steps remain: the board has to be started with the changed file before they can be done.
constexpr int exit_restart_board = 3;

std::vector<std::string> step_names() {
  std::vector<std::string> names(setup_steps.size());
  std::ranges::transform(setup_steps, names.begin(), &SetupStep::name);
  return names;
}

/// Without a name: the steps after all that are done.
bool wanted(const SetupStep& step, const SetupOptions& options, const SetupRecord& record) {
  const std::string name(step.name);
  if (options.steps.empty()) return !record.has(name) && !record.has_later_step(name);
  return std::ranges::find(options.steps, name) != options.steps.end();
}

/// Asks before a step that needs a person; without an answer, from a script either, it is skipped.
bool takes(const SetupStep& step, const SetupOptions& options,
           const std::optional<ScriptedAnswers>& script, Operator& user) {
  if (!step.needs_person || !options.steps.empty()) return true;
  const auto now = script ? Operator::Answer(script->has_table(step.name) ? 1.0 : 0.0)
                          : user.ask({step.name, "1: now, 0: skip it", {0.0, 1.0}, 0.0},
                                     [] { return Operator::Done(); });
  if (now && *now > 0.0) return true;
  if (!user.interrupted()) user.show("skipped; " + options.command(step.name) + " does it");
  return false;
}

int report_result(const SetupOptions& options, const Json& results, int status, std::string error) {
  // Errors in a file consist of whole lines.
  if (error.ends_with('\n')) error.pop_back();
  if (options.json) {
    Json report{{"steps", results}, {"restart_board", status == exit_restart_board}};
    if (!error.empty()) report["error"] = error;
    std::printf("%s\n", report.dump(2).c_str());
  }
  return error.empty() ? status : fail(status, error);
}

/// A step's error, with the step's name once.
std::string of_step(const std::string& step, const std::string& error) {
  return error.starts_with(step) ? error : step + ": " + error;
}

int run_steps(const SetupOptions& options, SetupRecord& record, std::FILE* out) {
  TerminalOperator terminal(out);
  std::optional<ScriptedAnswers> scripted;
  if (!options.script.empty()) {
    const auto script = read_script(options.script);
    if (!script)
      return report_result(options, Json::object(), exit_wrong_input, script.error().text());
    scripted = script->answers;
    terminal.take(*scripted);
  }
  SetupBoard board(options, terminal);
  if (options.steps.empty()) {
    if (const auto compared = board.compare_with(record); !compared)
      return report_result(options, Json::object(), exit_failed, compared.error().text());
  }
  Json results = Json::object();
  int status = exit_done;
  bool some_left = false;
  for (const SetupStep& step : setup_steps) {
    if (!wanted(step, options, record)) continue;
    const std::string name(step.name);
    const std::string left = options.steps.empty() ? board.left_out(name) : "";
    const std::string text = left.empty() ? std::string(step.does) : left;
    std::fprintf(out, "%s: %s\n", name.c_str(), text.c_str());
    std::fflush(out);
    if (!left.empty()) {
      some_left = true;
      continue;
    }
    if (!takes(step, options, scripted, terminal)) {
      if (terminal.interrupted())
        return report_result(options, results, exit_failed, "interrupted");
      continue;
    }
    const bool describes = name == "describe";
    const StepResult found = describes ? describe_step(options, terminal) : board.run(name);
    if (!found) {
      const int why = describes && !terminal.interrupted() ? exit_wrong_input : exit_failed;
      terminal.end_progress();
      if (!describes)
        return report_result(options, results, why, of_step(name, found.error().text()));
      return report_result(options, results, why, found.error().text());
    }
    results[name] = *found;
    if (auto kept = record.add(name, *found); !kept)
      return report_result(options, results, exit_failed, kept.error().text());
    if (!Commission::kept(*found)) status = exit_failed;
    // The board must run with the file as it is now.
    if (wrote_file(*found) && options.steps.empty()) {
      std::fprintf(out, "%s is %s: start the board with it, and run setup again to go on\n",
                   options.config.c_str(), describes ? "complete" : "changed");
      status = exit_restart_board;
      break;
    }
  }
  if (results.empty() && !some_left)
    std::fprintf(out, "every step is done; name one to do it again\n");
  return report_result(options, results, status, "");
}

/// At a terminal the user may decide on the spot.
bool undo_anyway(const SetupOptions& options, const std::string& why) {
  if (options.force) return true;
  if (options.json || isatty(STDIN_FILENO) == 0) return false;
  TerminalOperator terminal(stdout);
  terminal.show(why);
  const auto answer = terminal.ask({"undo", "1: undo it anyway, 0: leave it", {0.0, 1.0}, 0.0},
                                   [] { return Operator::Done(); });
  return answer && *answer > 0.0;
}

int undo_command(const SetupOptions& options) {
  const auto undone =
      undo_setup(options, [&](const std::string& why) { return undo_anyway(options, why); });
  if (!undone) return refuse(options.json, exit_failed, undone.error().text());
  if (options.json) {
    Json on_board = Json::array();
    for (const OnBoard& one : undone->on_board)
      on_board.push_back({{"what", one.what}, {"forgotten_by", one.forgotten_by}});
    const Json report{{"file", options.config},
                      {"channel", undone->channel},
                      {"step", undone->step},
                      {"kept_as", undone->kept_as},
                      {"on_board", on_board}};
    std::printf("%s\n", report.dump(2).c_str());
  } else {
    std::printf("%s\n", undone_text(options.config, *undone).c_str());
  }
  return exit_done;
}

}  // namespace

void add_setup(CLI::App& app, SetupOptions& o) {
  CLI::App* setup = app.add_subcommand(
      "setup",
      "Set up a muscle of your own, step by step, until it follows: describe it in a bench's "
      "units, compare its senses, calibrate, find limits, identify, choose gains, move. What has "
      "been done is remembered beside the board's file");
  setup
      ->add_option("STEP", o.steps,
                   "describe, doctor, senses, calibrate, scale, limits, identify, gains or move; a "
                   "step may be repeated [all that are not done yet]")
      ->check(CLI::Validator(
          [](const std::string& given) {
            const auto names = step_names();
            return std::ranges::find(names, given) != names.end()
                       ? std::string()
                       : given + ": " + suggestion_or_all(given, names, "the steps are");
          },
          ""));
  setup->add_option("--config", o.config, "The board's configuration, which setup completes")
      ->type_name("FILE")
      ->capture_default_str();
  setup->add_option("--channel", o.channel, "Channel of that file, from 1")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  setup
      ->add_option("--script", o.script,
                   "Answers in a TOML file's tables [muscle], [nameplate], [senses], [scale] and "
                   "[limits]; a step that they do not answer is skipped. Exit status 3: start the "
                   "board with the changed file, and run the same command again")
      ->type_name("FILE");
  CLI::Option* socket =
      setup->add_option("--socket", o.socket, "Where supercoild listens")->capture_default_str();
  setup
      ->add_option("--can", o.can,
                   "The board is on this bus: can0, or socketcand:[HOST:]PORT[/INTERFACE]")
      ->type_name("BUS")
      ->excludes(socket);
  CLI::Option* undo =
      setup->add_flag("--undo", o.undo,
                      "Put the file back as it was before setup's last change, and forget the step "
                      "that made it and all later ones; the present file is kept beside it");
  setup->add_flag("--force", o.force, "Undo even what was changed after setup wrote the file")
      ->needs(undo);
  setup->add_flag("--json", o.json, "Print what was found as one JSON object");
}

int setup_command(const SetupOptions& options) {
  watch_for_interrupts();
  if (options.undo) return undo_command(options);
  if (const std::string missing = missing_channel(options.config, options.channel);
      !missing.empty())
    return report_result(options, Json::object(), exit_wrong_input, missing);
  auto record = SetupRecord::open(options.config, options.channel);
  if (!record) return report_result(options, Json::object(), exit_failed, record.error().text());
  return run_steps(options, *record, options.json ? stderr : stdout);
}

}  // namespace supercoil::operating
