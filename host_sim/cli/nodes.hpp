// All boards of a run on one CAN bus, each with its own muscles, in lockstep.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "cli/node_run.hpp"
#include "runner/shared_bus.hpp"

namespace supercoil::host_sim {

class Nodes {
 public:
  /// boards: from on_one_bus(). A single board's results go to the folder itself, those of several
  /// boards to one subfolder each. The error says which folder cannot be written to. Options and
  /// folder must outlive it.
  static Result<Nodes> start(const RunOptions& options, const std::vector<Scenario>& boards,
                             const Window& window, OutputFolder& folder);

  /// Stores what boards learn from now on; learned must outlive the steps.
  void store_in(LearnedFolder& learned);
  void join_bus(SharedBus::Listener listener);
  /// After join_bus(): delivers a frame of another program.
  void deliver(const hal::CanFrame& frame) { bus_->deliver(frame); }

  /// All are at the same tick.
  const Simulation& first() const { return nodes_.front()->simulation(); }
  void step();
  /// Writes the remaining results and prints the figures. Returns the program's exit status.
  int conclude(double wall_s, const LearnedFolder& learned);

 private:
  Nodes(const RunOptions& options, OutputFolder& folder) : options_(&options), folder_(&folder) {}
  /// Prints all summaries; of several nodes as a list.
  void print_json() const;

  const RunOptions* options_;
  OutputFolder* folder_;
  std::vector<std::unique_ptr<OutputFolder>> folders_;  ///< of several nodes
  std::vector<std::unique_ptr<NodeRun>> nodes_;
  std::unique_ptr<SharedBus> bus_;
};

}  // namespace supercoil::host_sim
