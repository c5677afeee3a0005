// The commands of supercoil. Each returns the program's exit status.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/common/docs_options.hpp"
#include "apps/common/exit_status.hpp"
#include "apps/supercoil/board_socket.hpp"
#include "loop/settings.hpp"
#include "recorder/recording.hpp"

namespace supercoil::operating {

/// Prints the message to standard error and returns the status.
int fail(int status, const std::string& message);
/// {"error": message} on standard output, for programs that asked for JSON.
void print_error(const std::string& message);
/// Like fail(), and also as JSON if wanted.
int refuse(bool json, int status, const std::string& message);

struct LogOptions {
  std::string file;
  std::string out;                                           ///< empty: standard output
  double from_s = -std::numeric_limits<double>::infinity();  ///< relative to the fault
  double to_s = std::numeric_limits<double>::infinity();
  int channel = 0;  ///< from 1; 0: all
  bool damaged = false;
  bool summary = false;
  bool json = false;    ///< the summary as JSON
  bool mcap = false;    ///< instead of CSV
  int node = 0;         ///< of a CAN log, 1 to 63; 0: all
  std::string message;  ///< of a CAN log; empty: all
};
/// Reads a flight recording or a CAN log, whichever the file is.
int log_command(const LogOptions& options);
/// The file has no beginning of a flight recording.
int can_log_command(const LogOptions& options);
/// Writes everything to the sink, and returns the number of items that it counts.
using Produce = std::function<Result<std::size_t>(const recorder::Sink&)>;
/// Writes to options.out, or if that is empty to standard output. If there is nothing to write, or
/// the input would be replaced, it leaves no file and says so.
int write_output(const LogOptions& options, const std::string& nothing, const Produce& produce);

struct CommandOptions {
  std::string can;  ///< a bus; empty: the board on which this runs
  bool json = false;
  std::string socket = default_socket;
  std::vector<std::string> words;  ///< "state", or channel, verb, value
  double hold_s = 0.0;             ///< 0: once
  std::string sine_amplitude;      ///< a number, in degrees as 3deg
  double sine_period_s = 0.0;      ///< 0: no sine
  PlaceInJoint joint;              ///< where value and sine are in degrees
};
int command_command(CommandOptions options);

struct PlayOptions {
  std::string file;
  std::string can;  ///< a bus; empty: the board's own socket
  std::string socket = default_socket;
  int node = 1;           ///< of columns without a number
  double settle_s = 3.0;  ///< time at the first knot, before the start
  bool hold = false;      ///< hold the last knot, until Ctrl-C
  bool json = false;
};
int play_command(const PlayOptions& options);

struct SettingOptions {
  std::string can;  ///< a bus
  int node = 1;
  std::string name;             ///< empty: all
  std::optional<double> value;  ///< to write
  bool json = false;
};
int setting_command(const SettingOptions& options);

struct TuneOptions {
  std::string can;  ///< a bus; empty: the board on which this runs
  std::string socket = default_socket;
  int channel = 1;
  std::string controller = "0";          ///< its place or kind
  std::optional<std::string> estimator;  ///< its place or kind: that is tuned instead
  std::vector<std::string> assignments;  ///< NAME=VALUE
  std::string from = "in_use";           ///< the set to change
  bool only_prepare = false;
  bool store = false;
  bool clear = false;
  bool json = false;
};
int tune_command(const TuneOptions& options);

struct DoctorOptions {
  std::string config = "/etc/supercoil/board.toml";
  std::string run_folder = "/run/supercoil";
  int priority = 80;  ///< supercoild's
  int cpu = -1;       ///< supercoild's; negative: any
  std::string can;    ///< interface to check, e.g. can0; empty: that of [can]
  bool json = false;
  bool compare_senses = false;  ///< then can is a bus to command over; empty: the socket
  int channel = 1;
  double power_W = 0.0;  ///< for the comparison; 0: what is safe by the configuration
  std::string socket = default_socket;
};
/// Leads a person with a meter through a comparison of a running board's senses.
int compare_senses(const DoctorOptions& options);
int doctor_command(const DoctorOptions& options);

struct MonitorOptions {
  std::string source;                ///< an interface, socketcand:PORT or a candump log
  std::string listen = "127.0.0.1";  ///< address
  int port = 8080;                   ///< 0: a free one
  bool read_only = false;
  bool text = false;        ///< on the terminal; no page
  double keep_s = 3600.0;   ///< how far back a page that is opened later can see
  double bit_rate = 500e3;  ///< of the bus, to compute its load
  std::string setup;        ///< board's file for setup on the page; empty: none
  int channel = 1;          ///< of that file, from 1
};
int monitor_command(const MonitorOptions& options);

struct DbcOptions {
  std::vector<int> nodes;  ///< empty: node 1, under the messages' own names
  std::string out;         ///< empty: standard output
};
int dbc_command(const DbcOptions& options);

int docs_command(const DocsOptions& options);

}  // namespace supercoil::operating
