// supercoil-sim: the muscle and its firmware on any PC.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/common/command_line.hpp"
#include "apps/common/exit_status.hpp"
#include "campaign/study.hpp"
#include "cli/commands.hpp"
#include "cli/results_json.hpp"
#include "text/documentation.hpp"
#include "text/program_version.hpp"

namespace {

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::host_sim::campaign::max_runs;

/// "socketcand:PORT"
std::uint16_t port_of(const std::string& where) {
  constexpr std::string_view protocol = "socketcand:";
  const std::string_view text(where);
  std::uint16_t port = 0;
  const char* end = text.data() + text.size();
  const bool right = text.starts_with(protocol) && text.size() > protocol.size();
  const auto read = std::from_chars(right ? text.data() + protocol.size() : end, end, port);
  if (read.ec == std::errc{} && read.ptr == end) return port;
  throw CLI::ValidationError("--can", where + ": must be socketcand:PORT, a port from 0 to 65535");
}

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App* run =
      app.add_subcommand("run", "Simulate a scenario; write trace, summary, plot and CAN log");
  run->add_option(
         "SCENARIO", options.scenarios,
         "A TOML file, or a name from supercoil-sim list; several scenarios run as separate boards "
         "on one CAN bus")
      ->required();
  run->add_option("--out", options.out, "Folder for the results [supercoil-out/NAME]");
  run->add_option(
      "--window", options.window,
      "Time span FROM:TO in seconds over which the tracking error is computed [the whole run]");
  run->add_option("--every", options.every, "Ticks per row of the trace [1]")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000}));
  CLI::Option* learned =
      run->add_option("--learned", options.learned,
                      "Folder of the board's learned sets: read at its start and updated");
  run->add_option("--nodes", options.nodes,
                  "Boards on one CAN bus, each with its own muscle and noise")
      ->check(CLI::Range(1, 8))
      ->capture_default_str()
      ->excludes(learned);
  CLI::Option* board =
      run->add_option(
             "--board", options.boards,
             "Configure the firmware from this board's file and drive the scenario's muscle with "
             "it; with several scenarios, give it once for each [the scenario's own configuration]")
          ->type_name("FILE")
          ->allow_extra_args(false);
  run->add_option(
         "--channel", options.channels,
         "Channel of that board, from 1; with several scenarios, give it once for each [1]")
      ->check(CLI::Range(1, 16))
      ->allow_extra_args(false)
      ->needs(board);
  CLI::Option* no_trace = run->add_flag("!--no-trace", options.trace, "Write no trace");
  run->add_flag_callback(
         "--npy", [&] { options.trace_format = TraceFormat::npy; },
         "Write trace.npy for numpy and pandas instead of trace.csv")
      ->excludes(no_trace);
  run->add_flag("!--no-plot", options.plot, "Write no plot.svg");
  run->add_flag("!--no-can", options.can, "Write no can.log of the frames that the board sends");
  CLI::Option* real_time = run->add_flag(
      "--real-time", options.real_time,
      "Run in real time until the scenario ends or Ctrl-C, without trace, plot or CAN log");
  run->add_option_function<std::string>(
         "--can", [&](const std::string& where) { options.socketcand_port = port_of(where); },
         "socketcand:PORT: serve the board's CAN bus on this loopback port; 0 takes a free one")
      ->type_name("BUS")
      ->needs(real_time);
  run->add_flag("--end-with-parent", options.end_with_parent,
                "Also end when the parent process ends, for whatever reason")
      ->needs(real_time);
  CLI::Option* check = run->add_flag("--check", options.check,
                                     "Only check the scenario, and print what the muscle can do");
  run->add_flag("--keys", options.keys,
                "With --check, print every key that applies to the scenario instead, with the "
                "value in force, its default and what is allowed")
      ->needs(check);
  run->add_flag("--json", options.json,
                "Print JSON instead of text: summary.json, or the results of --check");
  run->add_flag("--allow-fault", options.allow_fault,
                "Exit with status 0 even if the muscle never armed or did not follow, or the run "
                "ended in a fault");
  run->add_flag("--quiet", options.quiet, "Print nothing but errors");
}

void add_page(CLI::App& app, PageOptions& options) {
  CLI::App* page = app.add_subcommand(
      "page", "Simulate a board in real time; serve a page that shows and moves its muscle");
  page->add_option("SCENARIO", options.scenario, "A TOML file, or a name from supercoil-sim list")
      ->capture_default_str();
  page->add_option("--port", options.port, "Port of the page, on 127.0.0.1; 0 takes a free one")
      ->check(CLI::Range(0, 65534))
      ->capture_default_str();
  page->add_option("--out", options.out, "Folder for the results [supercoil-out/NAME]");
}

CLI::Option* add_json(CLI::App& command, bool& json) {
  return command.add_flag("--json", json, "Print JSON instead of text");
}

void add_reproduce(CLI::App& app, ReproduceOptions& options) {
  CLI::App* reproduce = app.add_subcommand(
      "reproduce", "Reproduce the paper's figures and numbers; print them beside ours");
  reproduce->add_option("--out", options.out,
                        "Folder for the results [supercoil-out/reproduction]");
  reproduce->add_flag("!--no-plots", options.plots, "Write no plots and no report.html");
  add_json(*reproduce, options.json);
  reproduce->add_flag("--quiet", options.quiet, "Print nothing but errors");
}

/// "I/N"
batch::Shard shard_of(const std::string& text) {
  batch::Shard shard;
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec == std::errc{} && number.ptr != end && *number.ptr == '/') {
    const auto count = std::from_chars(number.ptr + 1, end, shard.count);
    if (count.ec == std::errc{} && count.ptr == end) return shard;
  }
  throw CLI::ValidationError("--shard", text + ": must be I/N with 1 <= I <= N");
}

void add_compare(CLI::App& app, CompareOptions& options) {
  CLI::App* compare = app.add_subcommand(
      "compare",
      "Compare controllers against disturbances over many seeds; resume where it was interrupted");
  const auto add_names = [&](const char* option, std::vector<std::string>& names,
                             const char* what) {
    compare->add_option(option, names, what)->delimiter(',')->type_name("NAMES");
  };
  add_names("--controllers", options.selection.controllers,
            "Names, or files with [controller] and [estimator], separated by commas [all]");
  add_names("--disturbances", options.selection.disturbances,
            "Names, or scenario files, separated by commas; NAME+SECONDS delays its events [all]");
  add_names("--arithmetic", options.selection.arithmetics, "double, float, q8.24 [double]");
  compare->add_option("--seeds", options.selection.seeds, "Number of seeds, starting at 1 [20]");
  compare->add_option("--jobs", options.jobs, "Number of parallel runs [one per processor]")
      ->check(CLI::Range(1, 1024));
  compare->add_option("--out", options.out, "Folder for the results [supercoil-out/compare]");
  CLI::Option* shard = compare->add_option_function<std::string>(
      "--shard", [&](const std::string& text) { options.selection.shard = shard_of(text); },
      "I/N: run only the I-th of N parts");
  shard->type_name("PART");
  compare
      ->add_option("--merge", options.merge,
                   "Run nothing; make the table from the runs.csv of several parts")
      ->type_name("FILES")
      ->excludes(shard);
  compare->add_flag("!--no-plot", options.plot, "Write no compare.svg");
  add_json(*compare, options.json);
  compare->add_flag("--quiet", options.quiet, "Print nothing but errors");
  compare->add_flag("--list", options.list, "List controllers, disturbances and measures");
}

void add_campaign(CLI::App& app, CampaignOptions& options) {
  CLI::App* campaign = app.add_subcommand(
      "campaign", "Run a study over many random muscles; resume where it was interrupted");
  campaign->add_option("STUDY", options.study, "A TOML file, or a name from --list");
  campaign->add_option("--runs", options.runs, "Number of runs; overrides the study's own")
      ->check(CLI::Range(std::int64_t{1}, max_runs));
  campaign->add_option("--jobs", options.jobs, "Number of parallel runs [one per processor]")
      ->check(CLI::Range(1, 1024));
  campaign->add_option("--out", options.out,
                       "Folder for the results [supercoil-out/campaign-NAME]");
  CLI::Option* shard = campaign->add_option_function<std::string>(
      "--shard", [&](const std::string& text) { options.shard = shard_of(text); },
      "I/N: run only the I-th of N parts");
  shard->type_name("PART");
  CLI::Option* merge =
      campaign
          ->add_option("--merge", options.merge,
                       "Run nothing; make the tables from the runs.csv of several parts")
          ->type_name("FILES")
          ->excludes(shard);
  constexpr int max_parts = 1000;  // of Slurm's default MaxArraySize
  CLI::Option* slurm =
      campaign
          ->add_option("--slurm", options.slurm,
                       "Write scripts for this many jobs of a Slurm cluster, and submit them")
          ->check(CLI::Range(1, max_parts))
          ->excludes(shard)
          ->excludes(merge);
  campaign->add_flag("!--no-submit", options.submit, "Write the scripts without submitting them")
      ->needs(slurm);
  constexpr std::int64_t max_search = 1'000'000;
  campaign
      ->add_option("--search", options.search,
                   "Search instead for each controller's worst run, in at most this many runs")
      ->check(CLI::Range(std::int64_t{1}, max_search))
      ->excludes(shard)
      ->excludes(slurm)
      ->excludes(merge);
  campaign->add_flag("!--no-plot", options.plot, "Write no campaign.svg");
  CLI::Option* check = campaign->add_flag("--check", options.check, "Only check the study")
                           ->excludes(slurm)
                           ->excludes(merge);
  campaign
      ->add_flag("--keys", options.keys,
                 "With --check, print every key that applies to the study instead, with the "
                 "value in force, its default and what is allowed")
      ->needs(check);
  add_json(*campaign, options.json)->excludes(slurm);
  campaign->add_flag("--quiet", options.quiet, "Print nothing but errors");
  campaign->add_flag("--list", options.list, "List studies and quantities");
}

void add_estimators(CLI::App& app, EstimatorsOptions& options) {
  CLI::App* estimators = app.add_subcommand("estimators",
                                            "Compare estimators with each other and the Cramer-Rao "
                                            "bound, on the same data over many seeds");
  constexpr std::int64_t max_seeds = 1000000;
  estimators->add_option("--seeds", options.seeds, "Number of seeds, starting at 1 [20]")
      ->check(CLI::Range(std::int64_t{1}, max_seeds));
  estimators->add_option("--jobs", options.jobs, "Number of parallel runs [one per processor]")
      ->check(CLI::Range(1, 1024));
  estimators->add_option("--out", options.out, "Folder for the results [supercoil-out/estimators]");
  estimators->add_flag("!--no-plot", options.plot, "Write no estimators.svg");
  add_json(*estimators, options.json);
  estimators->add_flag("--quiet", options.quiet, "Print nothing but errors");
}

/// Works even if the options cannot be read.
bool wants_json(int count, char** arguments) {
  return std::find(arguments, arguments + count, std::string_view("--json")) != arguments + count;
}

int run_program(int count, char** arguments) {
  CLI::App app{"Simulates super-coiled polymer muscles under supercoil's control.",
               "supercoil-sim"};
  app.set_version_flag("--version", std::string(program_version()));
  app.require_subcommand(1);
  RunOptions run;
  PageOptions page;
  DocsOptions docs;
  ReproduceOptions reproduce;
  CompareOptions compare;
  CampaignOptions campaign;
  EstimatorsOptions estimators;
  add_run(app, run);
  add_page(app, page);
  add_reproduce(app, reproduce);
  add_compare(app, compare);
  add_campaign(app, campaign);
  add_estimators(app, estimators);
  bool list_as_json = false;
  add_json(*app.add_subcommand("list", "List built-in scenarios, presets and reference models"),
           list_as_json);
  add_docs(app, docs);
  const bool json = wants_json(count, arguments);
  if (const std::string wrong = wrong_command(app, count, arguments); !wrong.empty())
    return refuse(json, exit_wrong_input, wrong);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    if (const std::string unexpected = unexpected_argument(app, error); !unexpected.empty())
      return refuse(json, exit_wrong_input, unexpected);
    if (json && error.get_exit_code() != 0) return refuse(json, exit_wrong_input, error.what());
    const int status = app.exit(error);
    return status == 0 ? exit_done : exit_wrong_input;
  }
  if (app.got_subcommand("run")) return run_command(run);
  if (app.got_subcommand("page")) return page_command(page);
  if (app.got_subcommand("docs")) return docs_command(docs);
  if (app.got_subcommand("reproduce")) return reproduce_command(reproduce);
  if (app.got_subcommand("compare")) return compare_command(compare);
  if (app.got_subcommand("campaign")) return campaign_command(campaign);
  if (app.got_subcommand("estimators")) return estimators_command(estimators);
  return list_command(list_as_json);
}

}  // namespace

int main(int count, char** arguments) {
  documentation_command = "supercoil-sim docs";
  try {
    const int status = run_program(count, arguments);
    return output_written() ? status : fail(exit_failed, "cannot write to standard output");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "supercoil-sim: %s\n", error.what());
    return exit_failed;
  }
}
