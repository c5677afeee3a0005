#include "compare/plan.hpp"

#include <cstdint>
#include <utility>

#include "compare/catalogue.hpp"
#include "compare/document.hpp"
#include "config/toml_file.hpp"
#include "scenario/read_scenario.hpp"

namespace supercoil::host_sim::compare {

namespace {

/// Where least squares is not available in fixed point, it runs in float.
void set_arithmetic(toml::table& document, const std::string& arithmetic) {
  apply_changes(document, toml::table{{"controller", toml::table{{"arithmetic", arithmetic}}}});
  const auto kind = document["estimator"]["kind"].value_or<std::string>("gradient");
  if (kind == "none") return;
  const bool narrow = kind == "least_squares" && arithmetic == "q8.24";
  apply_changes(
      document,
      toml::table{{"estimator", toml::table{{"arithmetic", narrow ? "float" : arithmetic}}}});
}

/// Four levels over the range of the disturbance's sine, each held for 5/ω: the paper's sine
/// becomes 5, 15, 8 and 20 mm, 20 s each. Without an event it runs for three rounds of them.
supercoil::Result<void> ask_for_steps(toml::table& document, const std::string& name) {
  const auto scenario = scenario_from(document, name);
  if (!scenario) return failure(config::to_text(scenario.error()));
  const Reference& sine = scenario->start.reference;
  if (sine.kind != ReferenceKind::sine) {
    return failure("--disturbances " + name + ": its [reference] is of kind " +
                   std::string(control::name_of(reference_names, sine.kind)) +
                   ", but :steps needs a sine\n");
  }
  const double offset_m = sine.offset;
  const double amplitude_m = sine.terms.front().amplitude;
  const double hold_s = 5.0 / sine.terms.front().angular_frequency_rad_per_s;
  toml::array levels_m;
  for (const double part : {-2.0 / 3.0, 4.0 / 9.0, -1.0 / 3.0, 1.0})
    levels_m.push_back(offset_m + part * amplitude_m);
  document.insert_or_assign(
      "reference", toml::table{{"kind", "steps"}, {"levels_m", levels_m}, {"hold_s", hold_s}});
  if (!document.contains("event")) {
    apply_changes(document,
                  toml::table{{"simulation", toml::table{{"duration_s", 12.0 * hold_s}}}});
  }
  return {};
}

/// For a controller that is tuned by hand to each muscle, the disturbance provides the keys.
void tune(toml::table& chosen, toml::table& disturbance, const std::string& controller) {
  if (const toml::table* tuned = disturbance["tuned"][controller].as_table())
    apply_changes(chosen, toml::table{{"controller", *tuned}});
  disturbance.erase("tuned");
}

supercoil::Result<Case> combine(const Document& controller, const Document& disturbance,
                                const std::string& arithmetic) {
  const std::string name = controller.name + " with " + disturbance.name + " in " + arithmetic;
  const auto parse = [](const Document& document, config::Diagnostics& diagnostics) {
    return config::parse(document.text, diagnostics);
  };
  config::Diagnostics of_controller(controller.name);
  config::Diagnostics of_disturbance(disturbance.name);
  toml::table document = parse(disturbance, of_disturbance);
  toml::table chosen = parse(controller, of_controller);
  if (!of_controller.empty() || !of_disturbance.empty()) {
    return failure(config::to_text(of_controller.problems()) +
                   config::to_text(of_disturbance.problems()));
  }
  // All controllers meet the same, whatever the disturbance was written for.
  erase_control(document);
  tune(chosen, document, controller.name);
  if (disturbance.steps) {
    if (auto asked = ask_for_steps(document, disturbance.name); !asked)
      return tl::unexpected(asked.error());
  }
  apply_changes(document, std::move(chosen));
  set_arithmetic(document, arithmetic);
  // The name has the delay of the events.
  const std::uint32_t definition =
      config::crc32_of(toml::table{{"scenario", document}, {"disturbance", disturbance.name}});
  auto scenario = scenario_from(std::move(document), name);
  if (!scenario) return failure(config::to_text(scenario.error()));
  scenario->duration_s += disturbance.later_s;
  for (Event& event : scenario->events)
    event.at_s += disturbance.later_s;
  return Case{controller.name, disturbance.name, arithmetic, definition, std::move(*scenario)};
}

/// Cases that fixed point cannot hold are left out; all others must be valid.
supercoil::Result<void> add_cases(Plan& plan, const std::vector<Document>& controllers,
                                  const std::vector<Document>& disturbances,
                                  const std::vector<std::string>& arithmetics) {
  for (const Document& controller : controllers) {
    for (const Document& disturbance : disturbances) {
      for (const std::string& arithmetic : arithmetics) {
        auto made = combine(controller, disturbance, arithmetic);
        if (made) {
          plan.cases.push_back(std::move(*made));
        } else if (arithmetic == "q8.24" && combine(controller, disturbance, "double")) {
          plan.impossible.push_back(made.error().text());
        } else {
          return tl::unexpected(made.error());
        }
      }
    }
  }
  return {};
}

std::string check(const Selection& s) {
  std::string problems;
  constexpr std::int64_t max_seeds = 100'000;
  if (s.seeds < 1 || s.seeds > max_seeds)
    problems += "--seeds " + std::to_string(s.seeds) + ": must be 1 to 100000\n";
  if (s.shard.count < 1 || s.shard.number < 1 || s.shard.number > s.shard.count) {
    problems += "--shard " + std::to_string(s.shard.number) + "/" + std::to_string(s.shard.count) +
                ": must be I/N with 1 <= I <= N\n";
  }
  for (const std::string& arithmetic : s.arithmetics) {
    if (!control::find_named(control::arithmetic_names, arithmetic))
      problems += "--arithmetic " + arithmetic + ": must be one of: double, float, q8.24\n";
  }
  return problems;
}

}  // namespace

std::vector<std::string> default_controllers() {
  return names_of(controllers());
}

std::vector<std::string> default_disturbances() {
  std::vector<std::string> names = names_of(disturbances());
  for (const char* muscle :
       {"real", "real_hard", "force", "softening", "hysteresis", "creep", "convection", "friction",
        "friction_2", "muscle_b", "muscle_c", "slow", "stiff", "small", "lightly_damped"})
    names.push_back(std::string(muscle) + ":steps");
  // The softening at ten more phases of the sine, whose period is 25.1 s.
  for (const char* later : {"2.5", "5", "7.5", "10", "12.5", "15", "17.5", "20", "22.5", "25"})
    names.push_back(std::string("stiffness+") + later);
  return names;
}

supercoil::Result<Plan> make_plan(const Selection& selection) {
  std::string problems = check(selection);
  const auto or_all = [](const std::vector<std::string>& chosen,
                         const std::vector<std::string>& all) {
    return chosen.empty() ? all : chosen;
  };
  const auto chosen = find_controllers(or_all(selection.controllers, default_controllers()));
  const auto met = find_disturbances(or_all(selection.disturbances, default_disturbances()));
  if (!chosen) problems += chosen.error().text();
  if (!met) problems += met.error().text();
  if (!problems.empty()) return failure(problems);

  Plan plan;
  const auto added = add_cases(plan, *chosen, *met, or_all(selection.arithmetics, {"double"}));
  if (!added) return tl::unexpected(added.error());
  std::int64_t index = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(selection.seeds); ++seed) {
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
      if (index++ % selection.shard.count == selection.shard.number - 1)
        plan.runs.push_back({i, seed});
    }
  }
  return plan;
}

}  // namespace supercoil::host_sim::compare
