#include <charconv>
#include <csignal>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "report/can_log.hpp"
#include "report/output_folder.hpp"
#include "report/run_plot.hpp"
#include "report/trace_writer.hpp"
#include "runner/summary.hpp"
#include "scenario/read_scenario.hpp"
#include "storage/posix_files.hpp"
#include "storage/store.hpp"

namespace supercoil::host_sim {

namespace {

std::optional<double> read_seconds(std::string_view text, double fallback) {
  if (text.empty()) return fallback;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "FROM:TO", "FROM:" or ":TO" within the run; empty text is the whole of it.
std::optional<Window> read_window(const std::string& text, double duration_s, double step_s) {
  if (text.empty()) return Window{0.0, duration_s};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const auto from = read_seconds(std::string_view(text).substr(0, colon), 0.0);
  const auto to = read_seconds(std::string_view(text).substr(colon + 1), duration_s);
  if (!from || !to || !(*from >= 0.0 && *from + step_s <= *to && *to <= duration_s))
    return std::nullopt;
  return Window{*from, *to};
}

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) {
  interrupted = 1;
}

/// Runs with whatever of trace and plot is wanted. False when it was interrupted before its end.
bool simulate(Simulation& simulation, Summary& summary, TraceWriter* trace, RunPlot* plot,
              Progress& progress) {
  constexpr long look_every = 16384;
  while (!simulation.done()) {
    const long tick = simulation.tick();
    const TickRecord record = simulation.step();
    summary.add(record);
    if (trace != nullptr && trace->wants(tick)) trace->add(record, simulation.estimate());
    if (plot != nullptr && plot->wants(tick)) plot->add(record, simulation.estimate());
    if (tick % look_every == 0) {
      if (interrupted != 0) return false;
      const double done = static_cast<double>(tick) / static_cast<double>(simulation.ticks());
      progress.show(done, std::to_string(static_cast<long>(record.time_s)) + " s simulated");
    }
  }
  return true;
}

void print_summary(const nlohmann::ordered_json& json, const std::string& folder) {
  std::printf("%s: %ld ticks in %.2f s, %.0f x real time\n",
              json["scenario"].get<std::string>().c_str(), json["ticks"].get<long>(),
              json["wall_s"].get<double>(), json["realtime_factor"].get<double>());
  if (!json["tracking_rms_m"].is_null()) {
    std::printf("tracking error %.1f um rms, %.1f um at most (%g to %g s)\n",
                json["tracking_rms_m"].get<double>() * 1e6,
                json["tracking_max_m"].get<double>() * 1e6, json["window_s"][0].get<double>(),
                json["window_s"][1].get<double>());
  }
  for (const auto& fault : json["faults"]) {
    std::printf("fault %d %s at %.3f s (docs/faults/%s.md)\n", fault["number"].get<int>(),
                fault["name"].get<std::string>().c_str(), fault["at_s"].get<double>(),
                fault["name"].get<std::string>().c_str());
  }
  std::printf("hottest %.1f K above ambient\nwritten to %s\n",
              json["hottest_temperature_rise_K"].get<double>(), folder.c_str());
}

}  // namespace

int run_command(const RunOptions& options) {
  storage::PosixFiles files;
  storage::LearnedStore store(options.learned, 1, files);
  std::optional<storage::Learned> learned;
  if (!options.learned.empty()) {
    const auto loaded = store.load();
    if (!loaded) return fail(exit_wrong_input, loaded.error());
    for (const std::string& problem : loaded->problems)
      std::fprintf(stderr, "supercoil-sim: %s\n", problem.c_str());
    learned = loaded->learned;
  }
  const auto scenario = read_scenario(options.scenario, learned);
  if (!scenario) {
    std::fputs(config::to_text(scenario.error()).c_str(), stderr);
    return exit_wrong_input;
  }
  const auto window = read_window(options.window, scenario->duration_s, scenario->step_s());
  if (!window) {
    return fail(exit_wrong_input, "--window " + options.window +
                                      ": must be FROM:TO in seconds, a tick or more within 0 to " +
                                      std::to_string(scenario->duration_s));
  }
  if (options.check) {
    std::printf("%s: in order, %ld ticks, %zu events\n", options.scenario.c_str(),
                scenario->ticks(), scenario->events.size());
    return exit_done;
  }
  auto folder =
      OutputFolder::open(options.out.empty() ? "supercoil-out/" + scenario->name : options.out);
  if (!folder) return fail(exit_wrong_input, folder.error());

  Progress progress(scenario->name, options.quiet);
  Simulation simulation(*scenario);
  recorder::FlightRecorder recorder(folder->path().string(), 1, scenario->rate_Hz, files);
  simulation.record_to(recorder);
  Summary summary(*window);
  std::optional<TraceWriter> trace;
  if (options.trace) trace.emplace(folder->temporary("trace.csv"), options.every);
  std::optional<CanLog> can_log;
  if (options.can) {
    const telemetry::CanSettings can;
    can_log.emplace(folder->temporary("can.log"), can.interface);
    simulation.join_bus(can, [&](const hal::CanFrame& frame) {
      can_log->add(frame, frame.received - simulation.start());
    });
  }
  std::optional<RunPlot> plot;
  if (options.plot) plot.emplace(*scenario);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  if (!simulate(simulation, summary, trace ? &*trace : nullptr, plot ? &*plot : nullptr,
                progress)) {
    return fail(exit_interrupted,
                "interrupted; nothing of this run is kept but recordings of faults");
  }
  if (summary.not_finite_ticks() > 0) {
    std::fprintf(
        stderr,
        "supercoil-sim: warning: the controller's power was no number in %ld ticks, first at %g s; "
        "none was applied then\n",
        summary.not_finite_ticks(), summary.first_not_finite_s());
  }
  recorder.finish();
  for (const recorder::RecorderNote& note : recorder.take_notes()) {
    if (note.problem || !options.quiet)
      std::fprintf(note.problem ? stderr : stdout, "%s\n", note.text.c_str());
  }
  if (!options.learned.empty() && simulation.learned()) {
    if (const auto saved = store.save(*simulation.learned()); !saved) {
      return fail(exit_failed, saved.error());
    }
  }
  const auto json = summary.to_json(*scenario, simulation, progress.elapsed_s());

  if (trace) {
    if (const auto finished = trace->finish(); !finished) {
      return fail(exit_failed, finished.error());
    }
  }
  if (can_log) {
    if (const auto finished = can_log->finish(); !finished) {
      return fail(exit_failed, finished.error());
    }
  }
  if (plot) {
    if (const auto drawn = draw(plot->figure(), folder->temporary("plot.svg")); !drawn) {
      // The run's results are worth more than their picture.
      folder->drop("plot.svg");
      std::fprintf(stderr, "supercoil-sim: plot.svg is not written: %s\n", drawn.error().c_str());
    }
  }
  if (const auto written =
          folder->write("summary.json",
                        json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
      !written) {
    return fail(exit_failed, written.error());
  }
  if (const auto done = folder->commit(); !done) return fail(exit_failed, done.error());
  if (!options.quiet) print_summary(json, folder->path().string());
  return exit_done;
}

}  // namespace supercoil::host_sim
