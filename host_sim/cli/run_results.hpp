// The results of a run: recordings, what was learned, summary.json, and text on standard output.
#pragma once

#include <string>

#include "supercoil/hal/error.hpp"

#include "cli/commands.hpp"
#include "cli/learned_folder.hpp"
#include "plot/figure.hpp"
#include "recorder/flight_recorder.hpp"
#include "report/output_folder.hpp"
#include "runner/summary.hpp"

namespace supercoil::host_sim {

/// Set by SIGINT and SIGTERM once catch_interrupts() was called.
void catch_interrupts();
bool interrupted();

/// How much was simulated: "12.3 s of 200 s".
std::string reached(const Simulation& simulation, const Scenario& scenario);

/// Prefix of a message about one of several boards.
std::string prefix(const RunOptions& options, const Scenario& scenario);

/// Writes the recorder's last file and prints its notes.
void finish(recorder::FlightRecorder& recorder, const RunOptions& options);

/// Writes summary.json to the folder and commits the folder; prints the figures unless quiet.
/// Returns the content of summary.json.
Result<std::string> conclude(const Summary& summary, const Scenario& scenario,
                             const ScenarioForecast& forecast, const Simulation& simulation,
                             double wall_s, OutputFolder& folder, bool quiet);

/// Whether the operator arms the muscle at some time, so that there is something to judge.
bool ever_arms(const Scenario& scenario);

/// Prints what else there is to say of the run; it is an error if nothing was followed. Returns the
/// program's exit status.
int report_outcome(const Summary& summary, const Scenario& scenario,
                   const ScenarioForecast& forecast, const Simulation& simulation,
                   const RunOptions& options);

/// Draws the figure into the folder and returns it, or reports why not and returns nothing: results
/// are worth more than their picture.
std::string write_svg(OutputFolder& folder, const Figure& figure, const std::string& name);

}  // namespace supercoil::host_sim
