// supercoil: the operator's tool beside the daemon.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "apps/common/command_line.hpp"
#include "apps/common/exit_status.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/identify/options.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "telemetry/frames.hpp"
#include "text/program_version.hpp"

namespace {

using namespace supercoil;
using namespace supercoil::operating;

void add_log(CLI::App& app, LogOptions& options) {
  CLI::App* log = app.add_subcommand(
      "log", "Print a flight recording as CSV, as MCAP or in words, or decode a CAN log");
  log->add_option("FILE", options.file, "A recording, flight-NUMBER.scfr, or a log of candump -L")
      ->required();
  CLI::Option* out = log->add_option("--out", options.out, "Write to this file [standard output]");
  CLI::Option* from = log->add_option("--from", options.from_s,
                                      "Start at this time in s; in a recording relative to the "
                                      "fault, in a CAN log the log's own time [the first]")
                          ->check(is_finite);
  CLI::Option* to =
      log->add_option("--to", options.to_s, "End at this time in s [the last]")->check(is_finite);
  CLI::Option* channel =
      log->add_option("--channel", options.channel, "Only this channel, 1 to 16 [all]")
          ->check(CLI::Range(1, 16));
  log->add_flag("--damaged", options.damaged, "Read what can be read of a damaged file");
  CLI::Option* summary =
      log->add_flag("--summary", options.summary, "Say what happened, in words; no CSV");
  CLI::Option* mcap = log->add_flag("--mcap", options.mcap, "Write MCAP instead of CSV");
  log->add_option("--node", options.node, "Only this node of a CAN log [all]")
      ->check(CLI::Range(1, can::max_nodes));
  log->add_option("--message", options.message,
                  "Only this message of a CAN log, a column for each signal [a row for each value]")
      ->type_name("NAME");
  log->add_flag("--json", options.json, "With --summary: print JSON instead of text")
      ->needs(summary);
  for (CLI::Option* of_csv : {out, from, to, channel, mcap})
    summary->excludes(of_csv);
}

/// An empty name, e.g. from an unset variable, must not mean the board on which this runs.
const CLI::Validator is_named(
    [](const std::string& name) {
      return std::string(name.empty() ? "a bus name is needed: can0, or socketcand:PORT" : "");
    },
    "");

void add_command(CLI::App& app, CommandOptions& options) {
  CLI::App* command = app.add_subcommand(
      "command", "Give one command to this board or to one on a CAN bus, or print its state");
  command
      ->add_option("COMMAND", options.words,
                   "state; or CHANNEL (from 1) and arm, disarm, reset, renew, rest, identify, "
                   "calibrate, position M (for a joint also 20deg), power W, scale M, controller "
                   "N, estimator N, store (keep what the estimator has learned), clear (forget the "
                   "stored muscle), tune N (apply the prepared values), store tuning, clear "
                   "tuning, compare_supply V, compare_current A, compare_rise K; N is a place in "
                   "the configuration, from 0, or a kind, e.g. pi")
      ->required()
      ->expected(1, -1);
  CLI::Option* hold = command->add_option(
      "--for", options.hold_s,
      "Renew the command for this many seconds or until Ctrl-C; then the muscle rests [sent once, "
      "then it expires; identify and calibrate are renewed until they end]");
  hold->check(is_finite)->check(is_positive);
  command
      ->add_flag_callback(
          "--hold", [&] { options.hold_s = std::numeric_limits<double>::infinity(); },
          "Renew the command until Ctrl-C; then the muscle rests")
      ->excludes(hold);
  CLI::Option* amplitude =
      command
          ->add_option("--amplitude", options.sine_amplitude,
                       "Amplitude of a sine about the value, in the same unit (0.003; for a "
                       "joint also 3deg); needs --for or --hold")
          ->type_name("VALUE");
  CLI::Option* period =
      command->add_option("--period", options.sine_period_s, "Period of the sine in s")
          ->check(is_finite)
          ->check(CLI::Range(0.2, 1e4));
  amplitude->needs(period);
  period->needs(amplitude);
  CLI::Option* socket = command->add_option("--socket", options.socket, "Where supercoild listens")
                            ->capture_default_str();
  command
      ->add_option("--can", options.can,
                   "Command over this bus instead, where CHANNEL is the node: can0, or "
                   "socketcand:[HOST:]PORT[/INTERFACE]")
      ->type_name("BUS")
      ->check(is_named)
      ->excludes(socket);
  command->add_flag("--json", options.json, "Print the answer as one line of JSON too");
}

void add_play(CLI::App& app, PlayOptions& options) {
  CLI::App* play = app.add_subcommand(
      "play", "Play the motion in a file on one armed muscle, or on several in step");
  play->add_option(
          "FILE", options.file,
          "CSV: time_s, position_m and, if wanted, velocity_m_per_s; for several channels or "
          "nodes 2:position_m and so on")
      ->required();
  CLI::Option* socket = play->add_option("--socket", options.socket, "Where supercoild listens")
                            ->capture_default_str();
  play->add_option("--can", options.can,
                   "Play over this bus instead, where the numbers of columns are nodes: can0, or "
                   "socketcand:[HOST:]PORT[/INTERFACE]")
      ->type_name("BUS")
      ->check(is_named)
      ->excludes(socket);
  play->add_option("--node,--channel", options.node, "Node of the columns without a number")
      ->check(CLI::Range(1, can::max_nodes))
      ->capture_default_str();
  play->add_option("--settle", options.settle_s, "Seconds to hold the first row before the start")
      ->check(is_finite)
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  play->add_flag("--hold", options.hold, "Hold the last row until Ctrl-C [the muscle rests]");
  play->add_flag("--json", options.json, "Print how it ended as one line of JSON");
}

void add_setting(CLI::App& app, SettingOptions& options) {
  CLI::App* setting =
      app.add_subcommand("setting",
                         "Read or change settings of a running board: maximum power, and how often "
                         "it sends each message. Changes last until it restarts");
  setting->add_option("NODE", options.node, "Node of the channel on the bus")
      ->required()
      ->check(CLI::Range(1, can::max_nodes));
  setting->add_option("NAME", options.name, "e.g. max_power_W [all]");
  setting->add_option("VALUE", options.value, "New value [print the present one]");
  setting->add_option("--can", options.can, "The bus: can0, or socketcand:[HOST:]PORT[/INTERFACE]")
      ->type_name("BUS")
      ->required();
  setting->add_flag("--json", options.json, "Print each setting as one line of JSON");
}

void add_tune(CLI::App& app, TuneOptions& options) {
  CLI::App* tune = app.add_subcommand(
      "tune",
      "Show or change the values of a channel's controllers and estimators while the board runs: "
      "gains, reference model, shaping, the law itself. A running controller takes them over "
      "without a jump; an estimator starts afresh");
  tune->add_option("CHANNEL", options.channel, "Channel, from 1; over CAN its node")
      ->required()
      ->check(CLI::Range(1, can::max_nodes));
  tune->add_option("ASSIGNMENT", options.assignments,
                   "NAME=VALUE, e.g. bandwidth_rad_per_s=6 or kind=pi [show all]")
      ->type_name("");
  CLI::Option* controller =
      tune->add_option("--controller", options.controller,
                       "Change this controller: its place in the configuration, from 0, or its "
                       "kind, e.g. pi, if only one has it")
          ->type_name("PLACE")
          ->capture_default_str();
  tune->add_option("--estimator", options.estimator,
                   "Change this estimator instead: its place, or its kind, e.g. gradient")
      ->type_name("PLACE")
      ->excludes(controller);
  tune->add_option("--from", options.from,
                   "Start from the values in_use, configured (to go back), stored or prepared")
      ->check(CLI::IsMember({"in_use", "configured", "stored", "prepared"}))
      ->capture_default_str();
  tune->add_flag("--prepare", options.only_prepare,
                 "Change only the prepared values, for later use");
  CLI::Option* store = tune->add_flag(
      "--store", options.store,
      "Keep what is in use, and which controller and estimator are chosen, for the next start");
  tune->add_flag("--clear", options.clear,
                 "Forget what was stored: the next start uses the configuration")
      ->excludes(store);
  CLI::Option* socket = tune->add_option("--socket", options.socket, "Where supercoild listens")
                            ->capture_default_str();
  tune->add_option("--can", options.can,
                   "Over this bus instead: can0, or socketcand:[HOST:]PORT[/INTERFACE]")
      ->type_name("BUS")
      ->check(is_named)
      ->excludes(socket);
  tune->add_flag("--json", options.json, "Print one JSON object");
}

void add_doctor(CLI::App& app, DoctorOptions& options) {
  CLI::App* doctor =
      app.add_subcommand("doctor",
                         "Check this board before anything is heated: kernel, rights, lines, PWM, "
                         "converters, watchdog. Heats nothing, except with --compare-senses; opens "
                         "devices only if supercoild is not running");
  doctor->add_option("--config", options.config, "The board's configuration")
      ->type_name("FILE")
      ->capture_default_str();
  doctor->add_option("--run-folder", options.run_folder, "Where supercoild's lock is")
      ->type_name("DIR")
      ->capture_default_str();
  doctor->add_option("--priority", options.priority, "Priority that supercoild is given")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  doctor->add_option("--cpu", options.cpu, "Processor that supercoild is given [any]")
      ->check(CLI::Range(0, 1023));
  doctor
      ->add_option("--can", options.can,
                   "Look at this CAN interface, e.g. can0 [that of the configuration]; with "
                   "--compare-senses command over this bus, can0 or "
                   "socketcand:[HOST:]PORT[/INTERFACE] [the supercoild of this board]")
      ->type_name("NAME");
  CLI::Option* compare = doctor->add_flag(
      "--compare-senses", options.compare_senses,
      "Instead compare the senses of a running board with a meter: heats a little, asks for the "
      "meter's volts and amperes at two powers, and narrows the bounds of its power");
  doctor->add_option("--channel", options.channel, "Channel to compare, from 1; over CAN its node")
      ->check(CLI::Range(1, can::max_nodes))
      ->capture_default_str()
      ->needs(compare);
  doctor
      ->add_option("--power", options.power_W,
                   "The greater of the two powers in W [a safe one by the configuration]")
      ->check(is_finite)
      ->check(CLI::Range(0.01, 1e3))
      ->needs(compare);
  doctor->add_option("--socket", options.socket, "Where supercoild listens, to compare")
      ->capture_default_str()
      ->needs(compare);
  doctor->add_flag("--json", options.json, "Print one JSON object instead of lines");
}

void add_monitor(CLI::App& app, MonitorOptions& options) {
  CLI::App* monitor = app.add_subcommand(
      "monitor", "Serve a page that shows the boards of a bus live, and commands them");
  monitor
      ->add_option("SOURCE", options.source,
                   "can0, socketcand:[HOST:]PORT[/INTERFACE], or a log of candump -L")
      ->required();
  monitor->add_option("--port", options.port, "Port of the page; 0 takes a free one")
      ->check(CLI::Range(0, 65534))
      ->capture_default_str();
  monitor
      ->add_option("--listen", options.listen,
                   "Address to listen on, e.g. 0.0.0.0 for all: viewing then needs the token too")
      ->type_name("ADDRESS")
      ->capture_default_str();
  CLI::Option* read_only =
      monitor->add_flag("--read-only", options.read_only, "Refuse all commands");
  CLI::Option* text =
      monitor->add_flag("--text", options.text, "Show the values on this terminal; serve no page");
  monitor->add_option("--keep", options.keep_s, "History in seconds that a newly opened page shows")
      ->check(is_finite)
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  monitor
      ->add_option("--bit-rate", options.bit_rate,
                   "Bit rate of the bus in bit/s, from which its load is computed")
      ->check(is_finite)
      ->check(CLI::Range(1e4, 1e6))
      ->capture_default_str();
  CLI::Option* setup =
      monitor
          ->add_option("--setup", options.setup,
                       "Offer the steps of supercoil setup on the page, for this board's file")
          ->type_name("FILE")
          ->check(CLI::ExistingFile)
          ->excludes(read_only)
          ->excludes(text);
  monitor->add_option("--channel", options.channel, "Channel of that file, from 1")
      ->check(CLI::Range(1, 16))
      ->needs(setup)
      ->capture_default_str();
}

void add_dbc(CLI::App& app, DbcOptions& options) {
  CLI::App* dbc = app.add_subcommand(
      "dbc", "Print the DBC of the CAN protocol, for node 1 or for the nodes of a bus");
  dbc->add_option("--nodes", options.nodes,
                  "Nodes of the bus, e.g. 1,2,5; each message's name then ends with its node")
      ->delimiter(',')
      ->check(CLI::Range(1, can::max_nodes));
  dbc->add_option("--out", options.out, "Write it to this file [standard output]");
}

/// Works even if the options cannot be parsed.
bool wants_json(int count, char** arguments) {
  return std::any_of(arguments, arguments + count,
                     [](const char* word) { return std::string_view(word) == "--json"; });
}

int run_program(int count, char** arguments) {
  CLI::App app{"Tools for boards that run supercoil.", "supercoil"};
  app.set_version_flag("--version", std::string(program_version()));
  app.require_subcommand(1);
  LogOptions log;
  add_log(app, log);
  CommandOptions command;
  add_command(app, command);
  PlayOptions play;
  add_play(app, play);
  SettingOptions setting;
  add_setting(app, setting);
  TuneOptions tune;
  add_tune(app, tune);
  DoctorOptions doctor;
  add_doctor(app, doctor);
  MonitorOptions monitor;
  add_monitor(app, monitor);
  IdentifyOptions identify;
  add_identify(app, identify);
  SetupOptions setup;
  add_setup(app, setup);
  DbcOptions dbc;
  add_dbc(app, dbc);
  DocsOptions docs;
  add_docs(app, docs);
  const bool json = wants_json(count, arguments);
  if (const std::string wrong = wrong_command(app, count, arguments); !wrong.empty())
    return refuse(json, exit_wrong_input, wrong);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    if (const std::string unexpected = unexpected_argument(app, error); !unexpected.empty())
      return refuse(json, exit_wrong_input, unexpected);
    const int status = app.exit(error);
    if (status == 0) return exit_done;
    if (json) print_error(error.what());
    return exit_wrong_input;
  }
  if (app.got_subcommand("doctor")) return doctor_command(doctor);
  if (app.got_subcommand("monitor")) return monitor_command(monitor);
  if (app.got_subcommand("setting")) return setting_command(setting);
  if (app.got_subcommand("tune")) return tune_command(tune);
  if (app.got_subcommand("play")) return play_command(play);
  if (app.got_subcommand("identify")) return identify_command(identify);
  if (app.got_subcommand("setup")) return setup_command(setup);
  if (app.got_subcommand("dbc")) return dbc_command(dbc);
  if (app.got_subcommand("docs")) return docs_command(docs);
  return app.got_subcommand("log") ? log_command(log) : command_command(command);
}

}  // namespace

int main(int count, char** arguments) {
  // A reader that closes the pipe early causes a write error, with its message and status.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const int status = run_program(count, arguments);
    return output_written() ? status : fail(exit_failed, "cannot write to standard output");
  } catch (const std::exception& error) {
    return fail(exit_failed, error.what());
  }
}
