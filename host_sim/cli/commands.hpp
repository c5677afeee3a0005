// The commands of supercoil-sim. Each returns the program's exit status: 0 done, 1 failed while
// running or nothing was followed, 2 wrong input (nothing was written), 130 interrupted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/docs_options.hpp"
#include "apps/common/exit_status.hpp"
#include "compare/plan.hpp"
#include "report/trace_writer.hpp"

namespace supercoil::host_sim {

inline constexpr int exit_interrupted = 130;  ///< by a signal; nothing is kept

/// Prints the message to standard error and returns the status.
int fail(int status, const std::string& message);

struct RunOptions {
  std::vector<std::string> scenarios;  ///< one board each, on one bus
  std::string out;                     ///< empty: supercoil-out/NAME
  std::string window;                  ///< "FROM:TO" in seconds, either may be empty
  std::int64_t every = 1;
  bool trace = true;
  TraceFormat trace_format = TraceFormat::csv;
  bool plot = true;
  bool can = true;
  bool real_time = false;
  std::optional<std::uint16_t> socketcand_port;  ///< in real time; 0: a free one
  bool end_with_parent = false;                  ///< in real time
  bool check = false;                            ///< only read the scenario
  bool keys = false;                             ///< and print its keys
  bool json = false;                             ///< on standard output, and no text
  bool quiet = false;
  bool allow_fault = false;  ///< a run that ends in a fault is not a failure
  std::string learned;       ///< folder; empty: nothing is remembered
  /// The firmware's configuration files, one per scenario; empty: the scenario's own configuration.
  std::vector<std::string> boards;
  std::vector<int> channels;  ///< of these, from 1; missing ones are 1
  int nodes = 1;              ///< boards on one bus, of a single scenario

  bool several_boards() const { return nodes > 1 || scenarios.size() > 1; }
};
int run_command(const RunOptions& given);

/// A simulated board, and the page on which it is watched and commanded.
struct PageOptions {
  std::string scenario = "bench";
  std::string out;  ///< empty: supercoil-out/NAME
  int port = 8080;  ///< of the page; 0: a free one
};
int page_command(const PageOptions& options);

/// Serves the documentation, as supercoil docs does.
int docs_command(const DocsOptions& options);

struct ReproduceOptions {
  std::string out = "supercoil-out/reproduction";
  bool plots = true;
  bool json = false;  ///< on standard output, instead of text; likewise below
  bool quiet = false;
};
int reproduce_command(const ReproduceOptions& options);

struct CompareOptions {
  compare::Selection selection;
  std::vector<std::string> merge;  ///< runs.csv files to merge; nothing is run then
  std::string out = "supercoil-out/compare";
  int jobs = 0;  ///< 0: as many as there are processors
  bool plot = true;
  bool json = false;
  bool quiet = false;
  bool list = false;  ///< only lists what there is to compare
};
int compare_command(const CompareOptions& options);

struct EstimatorsOptions {
  std::int64_t seeds = 20;  ///< seeds 1 to this
  int jobs = 0;             ///< 0: as many as there are processors
  std::string out = "supercoil-out/estimators";
  bool plot = true;
  bool json = false;
  bool quiet = false;
};
int estimators_command(const EstimatorsOptions& options);

struct CampaignOptions {
  std::string study;
  std::int64_t runs = 0;  ///< 0: as the study says
  batch::Shard shard;
  std::vector<std::string> merge;  ///< runs.csv files to merge; nothing is run then
  std::string out;                 ///< empty: supercoil-out/campaign-NAME
  int slurm = 0;                   ///< parts of a job array; 0: runs here
  std::int64_t search = 0;         ///< runs per controller to search for the worst; 0: no search
  bool submit = true;              ///< submits the jobs, not only writes them
  bool check = false;              ///< only reads the study
  bool keys = false;               ///< and prints its keys
  int jobs = 0;                    ///< 0: as many as there are processors
  bool plot = true;
  bool json = false;
  bool quiet = false;
  bool list = false;  ///< only lists the studies
};
int campaign_command(const CampaignOptions& given);

int list_command(bool as_json);

}  // namespace supercoil::host_sim
