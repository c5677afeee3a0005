#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <memory>

#include "cli/run_results.hpp"
#include "cli/runs.hpp"
#include "runner/pace.hpp"
#include "socketcand/server.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::host_sim {

namespace {

hal::Time since_1970() {
  return std::chrono::duration_cast<hal::Time>(std::chrono::system_clock::now().time_since_epoch());
}

/// Puts the board on a bus that others can join.
tl::expected<std::unique_ptr<SocketcandServer>, std::string> serve(Simulation& simulation,
                                                                   const std::string& interface,
                                                                   std::uint16_t port) {
  auto server = SocketcandServer::listen(
      port, interface, [&](const hal::CanFrame& frame) { simulation.bus()->deliver(frame); });
  if (!server) return server;
  // Frames are as far apart as on the board, whatever this machine's scheduler does.
  const hal::Time epoch = since_1970() - simulation.start();
  simulation.join_bus([bus = server->get(), epoch](const hal::CanFrame& frame) {
    bus->send(frame, frame.received + epoch);
  });
  std::printf("serving %s on 127.0.0.1:%d by the socketcand protocol\n", interface.c_str(),
              static_cast<int>((*server)->port()));
  return server;
}

}  // namespace

int live_run(const RunOptions& options, const Scenario& scenario, const Window& window,
             OutputFolder& folder, storage::LearnedStore& store) {
  catch_interrupts();  // before the first line tells others that it runs
  storage::PosixFiles files;
  Simulation simulation(scenario);
  recorder::FlightRecorder recorder(folder.path().string(), 1, scenario.rate_Hz, files);
  simulation.record_to(recorder);
  Summary summary(window);
  std::unique_ptr<SocketcandServer> server;
  if (options.socketcand_port) {
    auto served = serve(simulation, scenario.can.interface, *options.socketcand_port);
    if (!served) return fail(exit_wrong_input, served.error());
    server = std::move(*served);
  }
  if (!options.quiet) std::printf("%s in real time; Ctrl-C ends it\n", scenario.name.c_str());
  std::fflush(stdout);
  Pace pace(scenario.step_s());
  while (!simulation.done() && !interrupted()) {
    summary.add(simulation.step());
    if (server) server->poll();
    pace.wait();
  }
  if (!simulation.done() && !options.quiet) {
    // The terminal has shown ^C on this line.
    std::printf("\nended at %s\n", reached(simulation, scenario).c_str());
    std::fflush(stdout);
  }
  if (pace.slips() > 0) {
    std::fprintf(stderr, "supercoil-sim: warning: this machine was too slow %" PRId64 " times\n",
                 pace.slips());
  }
  if (const auto kept = keep(recorder, simulation, store, options); !kept)
    return fail(exit_failed, kept.error());
  const auto concluded =
      conclude(summary, scenario, simulation, pace.elapsed_s(), folder, options.quiet);
  if (!concluded) return fail(exit_failed, concluded.error());
  return asks(scenario) ? judge(summary, scenario, simulation, options) : exit_done;
}

}  // namespace supercoil::host_sim
