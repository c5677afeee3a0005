// A scenario on one board, and its results.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/learned_folder.hpp"
#include "recorder/flight_recorder.hpp"
#include "report/output_folder.hpp"
#include "report/run_plot.hpp"
#include "report/trace_writer.hpp"
#include "runner/summary.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::host_sim {

class NodeRun {
 public:
  /// Keeps trace and plot if the options ask for them, but not in real time. Options and folder
  /// must outlive it.
  NodeRun(const RunOptions& options, Scenario scenario, const Window& window, OutputFolder& folder);
  NodeRun(const NodeRun&) = delete;
  NodeRun& operator=(const NodeRun&) = delete;

  const TickRecord& step();
  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  /// Writes the remaining results and prints the figures. Returns the program's exit status.
  int conclude(double wall_s, const LearnedFolder& learned);
  /// The content of summary.json; empty: it is not written.
  const std::string& summary_json() const { return summary_json_; }

 private:
  void warn() const;

  const RunOptions* options_;
  Scenario scenario_;
  OutputFolder* folder_;
  storage::PosixFiles files_;
  Simulation simulation_;
  recorder::FlightRecorder recorder_;
  Summary summary_;
  std::unique_ptr<TraceWriter> trace_;
  std::optional<RunPlot> plot_;
  std::string summary_json_;
};

}  // namespace supercoil::host_sim
