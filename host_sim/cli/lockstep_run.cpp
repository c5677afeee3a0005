#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "cli/progress.hpp"
#include "cli/run_results.hpp"
#include "cli/runs.hpp"
#include "report/can_log.hpp"
#include "report/run_plot.hpp"
#include "report/trace_writer.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::host_sim {

namespace {

/// Runs with whatever of trace and plot is wanted. False when it was interrupted before its end.
bool simulate(Simulation& simulation, Summary& summary, TraceWriter* trace, RunPlot* plot,
              Progress& progress) {
  constexpr std::int64_t look_every = 16384;
  while (!simulation.done()) {
    const std::int64_t tick = simulation.tick();
    const TickRecord record = simulation.step();
    summary.add(record);
    if (trace != nullptr && trace->wants(tick)) trace->add(record, simulation.estimate());
    if (plot != nullptr && plot->wants(tick)) plot->add(record, simulation.estimate());
    if (tick % look_every == 0) {
      if (interrupted()) return false;
      const double done = static_cast<double>(tick) / static_cast<double>(simulation.ticks());
      progress.show(done,
                    std::to_string(static_cast<std::int64_t>(record.time_s)) + " s simulated");
    }
  }
  return true;
}

}  // namespace

int lockstep_run(const RunOptions& options, const Scenario& scenario, const Window& window,
                 OutputFolder& folder, storage::LearnedStore& store) {
  storage::PosixFiles files;
  Progress progress(scenario.name, options.quiet);
  Simulation simulation(scenario);
  recorder::FlightRecorder recorder(folder.path().string(), 1, scenario.rate_Hz, files);
  simulation.record_to(recorder);
  Summary summary(window);
  std::optional<TraceWriter> trace;
  if (options.trace) trace.emplace(folder.temporary("trace.csv"), options.every);
  std::optional<CanLog> can_log;
  if (options.can) {
    can_log.emplace(folder.temporary("can.log"), scenario.can.interface);
    simulation.join_bus([&](const hal::CanFrame& frame) {
      can_log->add(frame, frame.received - simulation.start());
    });
  }
  std::optional<RunPlot> plot;
  if (options.plot) plot.emplace(scenario);
  catch_interrupts();
  if (!simulate(simulation, summary, trace ? &*trace : nullptr, plot ? &*plot : nullptr,
                progress)) {
    progress.end();
    return fail(exit_interrupted, "interrupted at " + reached(simulation, scenario) +
                                      "; nothing of this run is kept but recordings of faults");
  }
  progress.end();
  if (summary.not_finite_ticks() > 0) {
    std::fprintf(stderr,
                 "supercoil-sim: warning: the controller's power was NaN in %" PRId64
                 " ticks, first at %g s; "
                 "none was applied then\n",
                 summary.not_finite_ticks(), summary.first_not_finite_s());
  }
  if (!std::isnan(summary.oscillated_at_s())) {
    std::fprintf(
        stderr,
        "supercoil-sim: warning: the control loop oscillated by itself, first seen at %g s with a "
        "period of %.2g s; docs/control.md says what to do\n",
        summary.oscillated_at_s(), summary.oscillation_period_s());
  }
  if (const auto kept = keep(recorder, simulation, store, options); !kept)
    return fail(exit_failed, kept.error());
  if (trace) {
    if (const auto finished = trace->finish(); !finished)
      return fail(exit_failed, (folder.path() / finished.error()).string());
  }
  if (can_log) {
    if (const auto finished = can_log->finish(); !finished)
      return fail(exit_failed, (folder.path() / finished.error()).string());
  }
  if (plot) draw_into(folder, plot->figure(), "plot.svg");
  const auto concluded =
      conclude(summary, scenario, simulation, progress.elapsed_s(), folder, options.quiet);
  if (!concluded) return fail(exit_failed, concluded.error());
  return judge(summary, scenario, simulation, options);
}

}  // namespace supercoil::host_sim
