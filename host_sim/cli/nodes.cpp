#include "cli/nodes.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "cli/one_bus.hpp"

namespace supercoil::host_sim {

Result<Nodes> Nodes::start(const RunOptions& options, const std::vector<Scenario>& boards,
                           const Window& window, OutputFolder& folder) {
  Nodes all(options, folder);
  for (const Scenario& board : boards) {
    Scenario its = board;
    OutputFolder* its_folder = &folder;
    if (boards.size() > 1) {
      const std::string number = std::to_string(int{its.can.first_node});
      its.name = name_on_bus(its);
      auto opened = OutputFolder::open(folder.path() / ("node-" + number));
      if (!opened) return tl::unexpected(opened.error());
      all.folders_.push_back(std::make_unique<OutputFolder>(std::move(*opened)));
      its_folder = all.folders_.back().get();
    }
    all.nodes_.push_back(std::make_unique<NodeRun>(options, std::move(its), window, *its_folder));
  }
  return all;
}

void Nodes::store_in(LearnedFolder& learned) {
  for (const auto& node : nodes_) {
    node->simulation().on_learned(
        [&learned](std::size_t channel, const board::LearnedUpdate& update) {
          learned.store(channel, update);
        });
  }
}

void Nodes::join_bus(SharedBus::Listener listener) {
  std::vector<Simulation*> boards;
  for (const auto& node : nodes_)
    boards.push_back(&node->simulation());
  bus_ = std::make_unique<SharedBus>(std::move(boards), std::move(listener));
}

void Nodes::step() {
  for (const auto& node : nodes_)
    node->step();
}

void Nodes::print_json() const {
  std::string text;
  for (const auto& node : nodes_) {
    std::string json = node->summary_json();
    if (json.empty()) return;  // it has reported why
    json.pop_back();
    text += (text.empty() ? "" : ",\n") + json;
  }
  std::puts((nodes_.size() == 1 ? text : "[" + text + "]").c_str());
}

int Nodes::conclude(double wall_s, const LearnedFolder& learned) {
  int status = exit_done;
  for (const auto& node : nodes_)
    status = std::max(status, node->conclude(wall_s, learned));
  if (options_->json) print_json();
  if (folders_.empty()) return status;
  if (const auto done = folder_->commit(); !done) return fail(exit_failed, done.error().text());
  return status;
}

}  // namespace supercoil::host_sim
