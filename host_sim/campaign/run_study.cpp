#include "campaign/run_study.hpp"

#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "compare/in_parallel.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// For a field of a table.
std::string without_commas(std::string text) {
  for (char& c : text) {
    if (c == ',') c = ';';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

/// Empty when it was given up.
std::optional<Outcome> carry_out(const Study& study, const Draws& draws, const Key& key,
                                 const std::atomic<bool>& stop) {
  const auto scenario = draws.scenario(draws.of_run(key.run), key.contender, key.run);
  if (scenario) return simulate(*scenario, study.window, stop);
  Outcome refused;
  const config::Problem& first = scenario.error().front();
  refused.refused = without_commas((first.key.empty() ? "" : first.key + ": ") + first.message);
  refused.values.fill(NAN);
  return refused;
}

}  // namespace

void run(const Study& study, const Draws& draws, const std::vector<Key>& runs, unsigned jobs,
         const Listener& listener) {
  compare::in_parallel(
      runs.size(), jobs,
      [&](std::size_t number, const std::atomic<bool>& stop) -> compare::Handover {
        const Key& key = runs[number];
        auto outcome = carry_out(study, draws, key, stop);
        if (!outcome) return {};
        return [&listener, &key, done = std::move(*outcome)] { listener.ended(key, done); };
      },
      listener.stop);
}

}  // namespace supercoil::host_sim::campaign
