#include "cli/node_run.hpp"

#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "cli/run_results.hpp"
#include "text/documentation.hpp"

namespace supercoil::host_sim {

NodeRun::NodeRun(const RunOptions& options, Scenario scenario, const Window& window,
                 OutputFolder& folder)
    : options_(&options),
      scenario_(std::move(scenario)),
      folder_(&folder),
      simulation_(scenario_),
      recorder_(folder.path().string(), scenario_.channels(), scenario_.rate_Hz, files_),
      summary_(window) {
  simulation_.record_to(recorder_);
  if (options.real_time) return;
  if (options.trace) {
    trace_ = write_trace(folder.temporary(trace_file(options.trace_format)), options.trace_format,
                         options.every, &scenario_.start);
    // An earlier run's trace would stay beside this run's summary.
    const bool csv = options.trace_format == TraceFormat::csv;
    folder.supersede(trace_file(csv ? TraceFormat::npy : TraceFormat::csv));
  }
  if (options.plot) plot_.emplace(scenario_);
}

const TickRecord& NodeRun::step() {
  const std::int64_t tick = simulation_.tick();
  const TickRecord& record = simulation_.step();
  summary_.add(record);
  if (trace_ && trace_->is_due(tick)) trace_->add(record, simulation_.estimate());
  if (plot_ && plot_->is_due(tick)) plot_->add(record, simulation_.estimate());
  return record;
}

void NodeRun::warn() const {
  const std::string node = prefix(*options_, scenario_);
  if (summary_.not_finite_ticks() > 0) {
    std::fprintf(stderr,
                 "supercoil-sim: %swarning: the controller's power was NaN in %" PRId64
                 " ticks, first at %g s; "
                 "no power was applied in those ticks\n",
                 node.c_str(), summary_.not_finite_ticks(), summary_.first_not_finite_s());
  }
  if (!std::isnan(summary_.oscillated_at_s())) {
    std::fprintf(
        stderr,
        "supercoil-sim: %swarning: the control loop oscillated by itself, first seen at %g s with "
        "a period of %.2g s; see %s\n",
        node.c_str(), summary_.oscillated_at_s(), summary_.oscillation_period_s(),
        documentation_page("control").c_str());
  }
}

int NodeRun::conclude(double wall_s, const LearnedFolder& learned) {
  if (!options_->real_time) warn();
  finish(recorder_, *options_);
  if (trace_) {
    if (const auto finished = trace_->finish(); !finished)
      return fail(exit_failed, (folder_->path() / finished.error().text()).string());
  }
  if (plot_) write_svg(*folder_, plot_->figure(), "plot.svg");
  const ScenarioForecast forecast(scenario_);
  auto concluded = host_sim::conclude(summary_, scenario_, forecast, simulation_, wall_s, *folder_,
                                      options_->quiet);
  if (!concluded) return fail(exit_failed, concluded.error().text());
  summary_json_ = std::move(*concluded);
  if (!learned.complete()) return exit_failed;  // the loss was reported
  if (options_->real_time && !ever_arms(scenario_)) return exit_done;
  return report_outcome(summary_, scenario_, forecast, simulation_, *options_);
}

}  // namespace supercoil::host_sim
