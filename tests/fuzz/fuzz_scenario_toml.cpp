// A scenario: either every mistake is named, or it makes a board whose firmware would start.
#include <cmath>
#include <string>

#include "fuzz/problems.hpp"
#include "runner/board_of.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text(data, size));
  const auto scenario = host_sim::parse_scenario(text, "scenario.toml");
  if (!scenario) {
    fuzz::require_named(scenario.error(), "scenario.toml", text);
    return 0;
  }
  fuzz::require(scenario->ticks() > 0, "a scenario lasts at least a tick");
  fuzz::require(!check(host_sim::firmware_of(*scenario)), "its firmware would start");
  host_sim::simulated_board_of(*scenario);
  double last_s = 0.0;
  for (const host_sim::Event& event : scenario->events) {
    fuzz::require(event.at_s >= last_s && event.at_s <= scenario->duration_s,
                  "events come in their order, within the run");
    last_s = event.at_s;
  }
  fuzz::require(std::isfinite(scenario->start.reference.at(scenario->duration_s)),
                "what is asked for is a number");
  return 0;
}
