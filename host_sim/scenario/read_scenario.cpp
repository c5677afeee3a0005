#include "scenario/read_scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "config/section.hpp"
#include "config/toml_file.hpp"
#include "scenario/builtin.hpp"
#include "scenario/read_tables.hpp"
#include "text/nearest.hpp"

namespace supercoil::host_sim {

namespace {

void read_simulation(const toml::table& document, Scenario& scenario,
                     config::Diagnostics& diagnostics) {
  config::Section section = config::Section(&document, "", diagnostics).section("simulation");
  scenario.duration_s = section.number("duration_s", scenario.duration_s, {1e-3, 1e6});
  scenario.rate_Hz = section.number("rate_Hz", scenario.rate_Hz, {100.0, 10e3});
  scenario.seed = static_cast<std::uint64_t>(section.integer("seed", 1, 0, 2147483647));
  scenario.substeps = static_cast<int>(section.integer("substeps", 1, 1, 1000));
  section.finish();
  if (scenario.ticks() < 1) {
    section.wrong("duration_s", "must be at least one tick: 1/rate_Hz");
  }
}

/// Keys for what is soldered, or given to the firmware at its start: they hold for the whole run.
constexpr std::array fixed_keys{"simulation",
                                "muscle",
                                "reference_model",
                                "event",
                                "thermal",
                                "ambient.warmest_C",
                                "ambient.coldest_C",
                                "ambient.sensor_error_K",
                                "senses",
                                "bundle.muscles",
                                "joint.opposed_by",
                                "joint.lever_m",
                                "joint.lever_range_deg",
                                "joint.antagonist_lever_m",
                                "joint.inertia_kg_m2",
                                "joint.spring_Nm_per_rad",
                                "joint.friction_ratio",
                                "joint.pretension_N",
                                "joint.hangs_at_deg",
                                "joint.min_angle_deg",
                                "joint.max_angle_deg",
                                "joint.antagonist_muscle",
                                "power.pwm_bits",
                                "power.delay_s",
                                "power.error_feedback",
                                "sensor.position.range_m",
                                "sensor.position.min_m",
                                "sensor.position.count_m",
                                "sensor.position.rate_Hz",
                                "sensor.position.resolution_bits"};

void refuse_fixed_keys(const toml::table& event, bool has_joint, bool has_bundle,
                       config::Diagnostics& diagnostics) {
  if (const toml::node* bundle = event.get("bundle"); bundle != nullptr && !has_bundle) {
    diagnostics.add(static_cast<int>(bundle->source().begin.line), "event.bundle",
                    "needs a [bundle] from the start");
  }
  if (const toml::node* joint = event.get("joint"); joint != nullptr && !has_joint) {
    diagnostics.add(static_cast<int>(joint->source().begin.line), "event.joint",
                    "needs a [joint] from the start");
  }
  for (const char* fixed : fixed_keys) {
    const toml::node* node = event.at_path(fixed).node();
    if (node == nullptr) continue;
    const auto line = static_cast<int>(node->source().begin.line);
    diagnostics.add(line, std::string("event.") + fixed, "cannot change during a run");
  }
}

/// An event as it is written, without its time.
struct WrittenEvent {
  double at_s;
  bool reset;
  toml::table changes;
};

/// "plant.load_N, power.gain"
std::string keys_of(const toml::table& changes, const std::string& path = "") {
  std::string keys;
  for (const auto& [key, node] : changes) {
    const std::string full = path + std::string(key.str());
    const toml::table* inner = node.as_table();
    keys += (keys.empty() ? "" : ", ") + (inner != nullptr ? keys_of(*inner, full + ".") : full);
  }
  return keys;
}

/// Takes the events out of the document, earliest first; reports each one whose time is missing or
/// wrong.
std::vector<WrittenEvent> take_events(toml::table& document, double duration_s,
                                      config::Diagnostics& diagnostics) {
  std::vector<WrittenEvent> events;
  toml::node* node = document.get("event");
  if (node == nullptr) return events;
  const toml::array* list = node->as_array();
  if (!node->is_array_of_tables() && !(list != nullptr && list->empty())) {
    diagnostics.add(static_cast<int>(node->source().begin.line), "event",
                    "must be written as [[event]], one for each");
  } else {
    for (toml::node& element : *node->as_array()) {
      toml::table& event = *element.as_table();
      refuse_fixed_keys(event, document.contains("joint"), document.contains("bundle"),
                        diagnostics);
      if (!event.contains("at_s")) {
        diagnostics.add(static_cast<int>(event.source().begin.line), "event.at_s",
                        "is missing: give the time of the event");
      }
      config::Section section(&event, "event", diagnostics);
      const double at_s = section.required_number("at_s", {0.0, duration_s});
      if (std::isnan(at_s)) continue;  // reported
      if (at_s == duration_s)
        section.wrong("at_s", "must be before the end of the run, duration_s");
      const bool reset = section.flag("reset", false);
      event.erase("at_s");
      event.erase("reset");
      events.push_back({at_s, reset, std::move(event)});
    }
  }
  document.erase("event");
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& x, const auto& y) { return x.at_s < y.at_s; });
  return events;
}

}  // namespace

// Moving (not copying) keeps each node's line.
void apply_changes(toml::table& document, toml::table&& changes) {
  for (auto&& [key, node] : changes) {
    toml::table* inner = document.get_as<toml::table>(key.str());
    toml::table* given = node.as_table();
    if (inner != nullptr && given != nullptr && !given->contains("kind")) {
      apply_changes(*inner, std::move(*given));
    } else {
      node.visit([&, name = key.str()](auto& value) {
        document.insert_or_assign(name, std::move(value));
      });
    }
  }
}

void erase_control(toml::table& document) {
  const auto erase_from = [](toml::table& table) {
    for (const char* key : {"controller", "estimator", "reference_model"})
      table.erase(key);
  };
  erase_from(document);
  toml::array* events = document.get_as<toml::array>("event");
  if (events == nullptr) return;
  for (toml::node& event : *events) {
    if (toml::table* table = event.as_table()) erase_from(*table);
  }
}

namespace {

KnownBefore known_before(const std::optional<board::Learned>& learned,
                         const control::PhysicalParameters& configured,
                         const PlantSettings& plant) {
  KnownBefore known;
  known.calibration.cold_resistance_Ohm = plant.resistance_Ohm;
  if (!learned) return known;
  known.calibration = learned->calibration;
  known.muscle_identified = !(learned->muscle == configured);
  known.response_ratio = learned->response_ratio;
  known.unexplained_ratio = learned->unexplained_ratio;
  known.identification = learned->identification;
  return known;
}

}  // namespace

ScenarioOrProblems parse_scenario(const std::string& text, const std::string& name,
                                  const LearnedMuscles& learned, Hardware hardware,
                                  config::KeyList* keys) {
  config::Diagnostics diagnostics(name);
  toml::table document = config::parse(text, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.problems());
  return scenario_from(std::move(document), name, learned, hardware, keys);
}

ScenarioOrProblems scenario_from(toml::table document, const std::string& name,
                                 const LearnedMuscles& learned, Hardware hardware,
                                 config::KeyList* keys) {
  config::Diagnostics diagnostics(name, keys);
  Scenario scenario;
  scenario.name = std::filesystem::path(name).stem().string();
  scenario.crc32 = config::crc32_of(document);
  read_simulation(document, scenario, diagnostics);
  std::vector<WrittenEvent> events = take_events(document, scenario.duration_s, diagnostics);
  const BelievedMuscles configured = read_muscles(document, diagnostics);
  BelievedMuscles believed = configured;
  if (learned[0]) believed.muscle = learned[0]->muscle;
  if (learned[1]) believed.antagonist = learned[1]->muscle;
  scenario.start = read_conditions(document, believed, scenario.step_s(), hardware, diagnostics);
  diagnostics.close_keys();
  const Conditions& start = scenario.start;
  scenario.known[0] = known_before(learned[0], configured.muscle, start.plant);
  scenario.known[1] =
      known_before(learned[1], configured.antagonist,
                   start.antagonist() != nullptr ? start.antagonist()->plant : start.plant);
  for (std::size_t i = 0; i < start.companions.size(); ++i)
    scenario.known[i + 1] = known_before(learned[i + 1], configured.muscle, start.companions[i]);
  // Each event is laid over all earlier ones, and the whole is read and checked again. Events at
  // the same time are one change: the second may make valid what the first alone would not.
  for (auto event = events.begin(); event != events.end() && diagnostics.empty(); ++event) {
    if (scenario.events.empty() || scenario.events.back().at_s != event->at_s) {
      scenario.events.push_back({event->at_s, {}, false, false, false});
    }
    Event& moment = scenario.events.back();
    moment.reset |= event->reset;
    moment.new_controller |= event->changes.contains("controller");
    moment.new_estimator |= event->changes.contains("estimator");
    const std::string changed = keys_of(event->changes);
    moment.changes += (moment.changes.empty() || changed.empty() ? "" : ", ") + changed;
    apply_changes(document, std::move(event->changes));
    const bool last_of_its_time = event + 1 == events.end() || (event + 1)->at_s != event->at_s;
    if (last_of_its_time) {
      moment.conditions =
          read_conditions(document, believed, scenario.step_s(), hardware, diagnostics);
      // The default depends on the muscle, but the sensor stays the same.
      moment.conditions.position_sensor.min_m = scenario.start.position_sensor.min_m;
      // Another weight stretches the muscle by more: 0 stays at its rest under the first weight.
      if (moment.conditions.joint)
        moment.conditions.joint->plant.pretension_N = scenario.start.joint->plant.pretension_N;
    }
  }
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.problems());
  return scenario;
}

ScenarioOrProblems read_scenario(const std::string& path, const LearnedMuscles& learned,
                                 Hardware hardware, config::KeyList* keys) {
  if (const auto text = builtin_scenario(path)) {
    return parse_scenario(std::string(*text), path, learned, hardware, keys);
  }
  config::Diagnostics diagnostics(path);
  const bool is_name = path.find('.') == std::string::npos && path.find('/') == std::string::npos;
  std::error_code unknown;
  if (is_name && !std::filesystem::exists(path, unknown)) {
    diagnostics.add(
        0, "",
        "there is no such file, and no built-in scenario has that name; " +
            suggestion_or_all(path, names_of(builtin_scenarios()), "the built-in scenarios are"));
    return tl::unexpected(diagnostics.problems());
  }
  const std::string text = config::read_text(path, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.problems());
  return parse_scenario(text, path, learned, hardware, keys);
}

}  // namespace supercoil::host_sim
