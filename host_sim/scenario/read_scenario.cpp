#include "scenario/read_scenario.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "config/section.hpp"
#include "config/toml_file.hpp"
#include "scenario/builtin.hpp"
#include "scenario/read_conditions.hpp"

namespace supercoil::host_sim {

namespace {

/// Moves the keys of `from` over those of `into`, table by table. A table that names its kind
/// replaces the old one, whose keys may not fit. Moving (not copying) keeps each node's line.
void overlay(toml::table& into, toml::table&& from) {
  for (auto&& [key, node] : from) {
    toml::table* inner = into.get_as<toml::table>(key.str());
    toml::table* given = node.as_table();
    if (inner != nullptr && given != nullptr && !given->contains("kind")) {
      overlay(*inner, std::move(*given));
    } else {
      node.visit(
          [&, name = key.str()](auto& value) { into.insert_or_assign(name, std::move(value)); });
    }
  }
}

void read_simulation(config::Section section, Scenario& scenario) {
  scenario.duration_s = section.number("duration_s", scenario.duration_s, {1e-3, 1e6});
  scenario.rate_Hz = section.number("rate_Hz", scenario.rate_Hz, {100.0, 10e3});
  scenario.seed = static_cast<std::uint64_t>(section.integer("seed", 1, 0, 2147483647));
  scenario.substeps = static_cast<int>(section.integer("substeps", 1, 1, 1000));
  section.finish();
}

/// What an event may name; [simulation] holds for the whole run.
void refuse_fixed_keys(const toml::table& event, config::Diagnostics& diagnostics) {
  for (const char* fixed : {"simulation", "muscle", "reference_model"}) {
    const toml::node* node = event.get(fixed);
    if (node == nullptr) continue;
    const auto line = static_cast<int>(node->source().begin.line);
    diagnostics.add(line, std::string("event.") + fixed, "cannot change during a run");
  }
}

/// The document with the first `count` events laid over it, parsed anew so that lines are kept.
/// Returns the time of the last one.
class Timeline {
 public:
  Timeline(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {}

  struct Moment {
    toml::table document;
    double at_s = 0.0;
    bool new_controller = false;
    bool new_estimator = false;
  };

  /// order: indices of the events to lay over, earliest first.
  Moment after(const std::vector<std::size_t>& order, std::size_t count) const {
    config::Diagnostics ignored(name_);
    Moment moment;
    moment.document = config::parse(text_, ignored);
    if (count > 0) {
      toml::array& events = *moment.document.get_as<toml::array>("event");
      for (std::size_t i = 0; i < count; ++i) {
        toml::table& event = *events[order[i]].as_table();
        moment.at_s = event["at_s"].value_or(0.0);
        moment.new_controller = event.contains("controller");
        moment.new_estimator = event.contains("estimator");
        event.erase("at_s");
        overlay(moment.document, std::move(event));
      }
    }
    moment.document.erase("event");
    return moment;
  }

 private:
  std::string text_;
  std::string name_;
};

/// The events' indices by time; notes each that is not a table, has no time or a wrong one.
std::vector<std::size_t> order_events(const toml::table& document, double duration_s,
                                      config::Diagnostics& diagnostics) {
  std::vector<std::pair<double, std::size_t>> times;
  const toml::node* node = document.get("event");
  if (node == nullptr) return {};
  if (!node->is_array_of_tables()) {
    diagnostics.add(static_cast<int>(node->source().begin.line), "event",
                    "must be written as [[event]], one for each");
    return {};
  }
  const toml::array& events = *node->as_array();
  for (std::size_t i = 0; i < events.size(); ++i) {
    const toml::table& event = *events[i].as_table();
    config::Section section(&event, "event", diagnostics);
    refuse_fixed_keys(event, diagnostics);
    if (!event.contains("at_s")) {
      diagnostics.add(static_cast<int>(event.source().begin.line), "event.at_s",
                      "is missing: when does the event happen?");
    }
    times.emplace_back(section.number("at_s", 0.0, {0.0, duration_s}), i);
  }
  std::stable_sort(times.begin(), times.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::size_t> order;
  order.reserve(times.size());
  for (const auto& [time, index] : times)
    order.push_back(index);
  return order;
}

}  // namespace

long Scenario::ticks() const {
  return std::lround(duration_s * rate_Hz);
}

ScenarioOrProblems parse_scenario(const std::string& text, const std::string& name) {
  config::Diagnostics diagnostics(name);
  toml::table document = config::parse(text, diagnostics);
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.problems());

  Scenario scenario;
  scenario.name = std::filesystem::path(name).stem().string();
  config::Section root(&document, "", diagnostics);
  read_simulation(root.section("simulation"), scenario);
  const auto order = order_events(document, scenario.duration_s, diagnostics);
  document.erase("event");

  const auto believed = read_muscle(document, diagnostics);
  scenario.start = read_conditions(document, believed, scenario.step_s(), diagnostics);
  const Timeline timeline(text, name);
  for (std::size_t count = 1; diagnostics.empty() && count <= order.size(); ++count) {
    const auto moment = timeline.after(order, count);
    Event event{moment.at_s, {}, moment.new_controller, moment.new_estimator};
    event.conditions = read_conditions(moment.document, believed, scenario.step_s(), diagnostics);
    scenario.events.push_back(std::move(event));
  }
  if (!diagnostics.empty()) return tl::unexpected(diagnostics.problems());
  return scenario;
}

ScenarioOrProblems read_scenario(const std::string& path) {
  if (const auto text = builtin_scenario(path)) return parse_scenario(std::string(*text), path);
  config::Diagnostics diagnostics(path);
  const std::string text = config::read_text(path, diagnostics);
  if (!diagnostics.empty()) {
    if (path.find('.') == std::string::npos && path.find('/') == std::string::npos) {
      diagnostics.add(0, "", "and no built-in scenario is called so (see supercoil-sim list)");
    }
    return tl::unexpected(diagnostics.problems());
  }
  return parse_scenario(text, path);
}

}  // namespace supercoil::host_sim
