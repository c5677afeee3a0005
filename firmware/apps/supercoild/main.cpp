// supercoild: the firmware as a program.
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/common/command_line.hpp"
#include "apps/common/exit_status.hpp"
#include "apps/supercoild/commands.hpp"
#include "apps/supercoild/locked_memory.hpp"
#include "text/program_version.hpp"

namespace {

using namespace supercoil;

/// Options that require --latency report it when given without it.
void add_latency(CLI::App& app, daemon::LatencyOptions& options, bool& wanted) {
  CLI::Option* latency = app.add_flag(
      "--latency", wanted,
      "Measure how late the loop wakes and how long its ticks take, without opening any device, "
      "and end");
  CLI::Option* rate =
      app.add_option("--rate", options.rate_Hz, "Loop rate in Hz of one channel, without --config")
          ->check(is_finite)
          ->check(CLI::Range(100.0, 10e3))
          ->capture_default_str();
  CLI::Option* seconds = app.add_option("--seconds", options.seconds, "Seconds to measure")
                             ->check(is_finite)
                             ->check(CLI::Range(0.1, 1e6))
                             ->capture_default_str();
  CLI::Option* ticks = app.add_option("--ticks", options.ticks, "Ticks to measure")
                           ->check(is_finite)
                           ->check(CLI::Range(1.0, 1e9))
                           ->excludes(seconds);
  CLI::Option* plot =
      app.add_option("--plot", options.plot, "Draw the histograms (gnuplot)")->type_name("SVG");
  rate->excludes("--config");
  for (CLI::Option* option : {rate, seconds, ticks, plot})
    option->needs(latency)->group("With --latency");
  latency->excludes("--check")->excludes("--off");
}

int run_program(int count, char** arguments) {
  CLI::App app{
      "The firmware of a board that drives super-coiled polymer muscles.\n"
      "Drives the board until SIGTERM, SIGINT or SIGHUP, then cools the muscles and ends. It "
      "starts disarmed.",
      "supercoild"};
  app.set_version_flag("--version", std::string(program_version()));
  std::string file;
  daemon::RunOptions options;
  CLI::Option* check =
      app.add_option("--check", file,
                     "Read a board's configuration, print what was understood, and exit")
          ->type_name("FILE");
  bool keys = false;
  app.add_flag("--keys", keys,
               "With --check, print every key that applies to the file instead, with the value in "
               "force, its default and what is allowed")
      ->needs(check);
  bool off = false;
  app.add_flag("--off", off, "Set every line low and every duty to 0, and end")->excludes(check);
  app.add_option("--config", options.config, "The board's configuration")
      ->type_name("FILE")
      ->capture_default_str();
  app.add_option("--run-folder", options.run_folder,
                 "Where the lock and the socket for local commands are")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_option("--priority", options.priority,
                 "SCHED_FIFO priority of the loop; 0: no real-time scheduling")
      ->check(CLI::Range(0, 99))
      ->capture_default_str();
  app.add_option("--cpu", options.cpu, "The loop's own CPU [any]")->check(CLI::Range(0, 1023));
  daemon::LatencyOptions latency;
  bool measures = false;
  add_latency(app, latency, measures);
  bool as_json = false;
  app.add_flag("--json", as_json, "With --check or --latency: print JSON instead of text");
  try {
    app.parse(count, arguments);
    if (as_json && !measures && app.count("--check") == 0)
      throw CLI::RequiresError("--json", "--check or --latency");
  } catch (const CLI::ParseError& error) {
    if (const std::string unexpected = unexpected_argument(app, error); !unexpected.empty()) {
      std::fprintf(stderr, "supercoild: %s\n", unexpected.c_str());
      return exit_wrong_input;
    }
    const int status = app.exit(error);
    return status == 0 ? exit_done : exit_wrong_input;
  }
  if (keys) return daemon::keys_command(file, as_json);
  if (app.count("--check") > 0) return daemon::check_command(file, as_json);
  if (off) return daemon::off_command(options.config, options.run_folder);
  if (!measures) return daemon::run_command(options);
  if (app.count("--config") > 0) latency.config = options.config;
  latency.json = as_json;
  latency.priority = options.priority;
  latency.cpu = options.cpu;
  return daemon::latency_command(latency);
}

}  // namespace

int main(int count, char** arguments) {
  supercoil::daemon::limit_heap();
  // A closed log or pipe must not end the process and drop the muscles.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const int status = run_program(count, arguments);
    if (output_written()) return status;
    std::fputs("supercoild: cannot write to standard output\n", stderr);
    return exit_failed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "supercoild: %s\n", error.what());
    return exit_failed;
  }
}
