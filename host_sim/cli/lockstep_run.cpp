#include <cstdint>
#include <optional>
#include <string>

#include "apps/common/progress.hpp"
#include "cli/nodes.hpp"
#include "cli/run_results.hpp"
#include "cli/runs.hpp"
#include "report/can_log.hpp"

namespace supercoil::host_sim {

namespace {

/// False when it was interrupted before its end.
bool simulate(Nodes& nodes, Progress& progress) {
  constexpr std::int64_t look_every = 2048;
  const Simulation& first = nodes.first();
  while (!first.done()) {
    const std::int64_t tick = first.tick();
    nodes.step();
    if (tick % look_every != 0) continue;
    if (interrupted()) return false;
    const double done = static_cast<double>(tick) / static_cast<double>(first.ticks());
    progress.show(done, std::to_string(static_cast<std::int64_t>(first.time_s())) + " s simulated");
  }
  return true;
}

}  // namespace

int lockstep_run(const RunOptions& options, const std::vector<Scenario>& boards,
                 const Window& window, OutputFolder& folder, LearnedFolder& learned) {
  const Scenario& scenario = boards.front();  // for what all boards have in common
  const std::string name = name_of(boards);
  Progress progress(name, options.quiet);
  auto nodes = Nodes::start(options, boards, window, folder);
  if (!nodes) return fail(exit_wrong_input, nodes.error().text());
  nodes->store_in(learned);
  std::optional<CanLog> can_log;
  if (options.can) {
    can_log.emplace(folder.temporary("can.log"), scenario.can.interface);
    nodes->join_bus([&](const hal::CanFrame& frame, hal::Time since_start) {
      can_log->add(frame, since_start);
    });
  }
  catch_interrupts();
  const bool complete = simulate(*nodes, progress);
  progress.end();
  if (!complete) {
    return fail(exit_interrupted, "interrupted at " + reached(nodes->first(), scenario) +
                                      "; only recordings of faults" +
                                      (options.learned.empty() ? "" : " and learned sets") +
                                      " are kept");
  }
  if (can_log) {
    if (const auto finished = can_log->finish(); !finished)
      return fail(exit_failed, (folder.path() / finished.error().text()).string());
  }
  return nodes->conclude(progress.elapsed_s(), learned);
}

}  // namespace supercoil::host_sim
