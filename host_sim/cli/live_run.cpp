#include <chrono>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include <unistd.h>

#include "apps/common/progress.hpp"
#include "cli/nodes.hpp"
#include "cli/run_results.hpp"
#include "cli/runs.hpp"
#include "runner/pace.hpp"
#include "socketcand/server.hpp"
#include "text/number_text.hpp"

namespace supercoil::host_sim {

namespace {

hal::Time since_1970() {
  return std::chrono::duration_cast<hal::Time>(std::chrono::system_clock::now().time_since_epoch());
}

/// Puts the boards on a bus that others can join.
Result<std::unique_ptr<SocketcandServer>> serve(Nodes& nodes, const std::string& interface,
                                                std::uint16_t port, std::FILE* out) {
  auto server = SocketcandServer::listen(port, interface,
                                         [&](const hal::CanFrame& frame) { nodes.deliver(frame); });
  if (!server) return server;
  // Frames are spaced as on the board, whatever this machine's scheduler does.
  nodes.join_bus([bus = server->get(), epoch = since_1970()](const hal::CanFrame& frame,
                                                             hal::Time since_start) {
    bus->send(frame, since_start + epoch);
  });
  std::fprintf(out, "serving %s on 127.0.0.1:%d by the socketcand protocol\n", interface.c_str(),
               static_cast<int>((*server)->port()));
  return server;
}

/// Ticks between two looks at the clock.
constexpr std::int64_t ticks_a_look = 16;

/// "12 s of 86400 s simulated": without a fraction, so that the line does not flicker.
std::string in_seconds(const Simulation& simulation, const Scenario& scenario) {
  return std::to_string(static_cast<std::int64_t>(simulation.time_s())) + " s of " +
         number_text(scenario.duration_s, 9) + " s simulated";
}

}  // namespace

int live_run(const RunOptions& options, const std::vector<Scenario>& boards, const Window& window,
             OutputFolder& folder, LearnedFolder& learned) {
  const Scenario& scenario = boards.front();  // for what all boards have in common
  const std::string name = name_of(boards);
  catch_interrupts();  // before the first line tells others that it runs
  const pid_t parent = getppid();
  auto nodes = Nodes::start(options, boards, window, folder);
  if (!nodes) return fail(exit_wrong_input, nodes.error().text());
  nodes->store_in(learned);
  std::unique_ptr<SocketcandServer> server;
  if (options.socketcand_port) {
    auto served = serve(*nodes, scenario.can.interface, *options.socketcand_port,
                        options.json ? stderr : stdout);
    if (!served) return fail(exit_wrong_input, served.error().text());
    server = std::move(*served);
  }
  if (!options.quiet) std::printf("%s in real time; Ctrl-C ends it\n", name.c_str());
  std::fflush(stdout);
  Progress progress(name, options.quiet);
  Pace pace(scenario.step_s());
  const Simulation& first = nodes->first();
  const auto is_orphan = [&] { return options.end_with_parent && getppid() != parent; };
  while (!first.done() && !interrupted() && !is_orphan()) {
    nodes->step();
    if (server) server->poll();
    if (first.tick() % ticks_a_look == 0) {
      progress.show(static_cast<double>(first.tick()) / static_cast<double>(first.ticks()),
                    in_seconds(first, scenario));
    }
    pace.wait();
  }
  progress.end();
  if (!first.done() && !options.quiet) {
    // The terminal has shown ^C on this line.
    std::printf("\nended at %s\n", reached(first, scenario).c_str());
    std::fflush(stdout);
  }
  if (pace.slips() > 0) {
    std::fprintf(stderr,
                 "supercoil-sim: warning: this machine was too slow for real time %" PRId64
                 " times\n",
                 pace.slips());
  }
  return nodes->conclude(pace.elapsed_s(), learned);
}

}  // namespace supercoil::host_sim
