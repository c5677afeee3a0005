#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "campaign/outcome.hpp"
#include "campaign/study.hpp"
#include "config/section.hpp"
#include "config/toml_file.hpp"
#include "scenario/read_scenario.hpp"
#include "storage/crc32.hpp"
#include "text/nearest.hpp"

namespace supercoil::host_sim::campaign {

namespace {

using config::any_number;
using config::Diagnostics;
using config::Section;

/// Characters that would break a line of runs.csv.
constexpr std::string_view separators = ",\"\n\r|";

/// "[a, b]", the second above the first.
void read_ends(Section& section, const std::string& key, double lowest, Distribution& into) {
  const auto ends = section.required_numbers(key, {lowest, any_number.max}, 2, 2);
  if (ends.empty()) return;
  into.first = ends[0];
  into.second = ends[1];
  if (!(ends[0] < ends[1])) section.wrong(key, "the second value must be greater than the first");
}

void read_normal(Section& section, Distribution& into) {
  const auto given = section.required_numbers("normal", any_number, 2, 2);
  into.min = section.number("min", into.min, any_number);
  into.max = section.number("max", into.max, any_number);
  if (given.empty()) return;
  into.first = given[0];
  into.second = given[1];
  if (!(into.second > 0.0)) section.wrong("normal", "the standard deviation must be above 0");
  if (!(into.min < into.max)) return section.wrong("min", "must be below max");
  constexpr double low = 0.25;
  constexpr double high = 0.75;
  if (into.second > 0.0 && !(into.at(low) < into.at(high)))
    section.wrong("min", "almost none of the distribution lies between min and max");
}

toml::array read_list(Section& section, Distribution& into) {
  toml::array list = section.required_values("list");
  const auto breaks_line = [](const toml::node& one) {
    const auto text = one.value_exact<std::string>();
    return text && text->find_first_of(separators) != std::string::npos;
  };
  if (std::any_of(list.begin(), list.end(), breaks_line))
    section.wrong("list", "must not contain a text with a comma, quote, bar or line break");
  into.values = list.size();
  return list;
}

/// Exactly one of the keys that name a distribution must be there.
void read_distribution(Section& section, Draw& draw) {
  using Kind = Distribution::Kind;
  static constexpr control::Names<Kind, 5> kinds{{{"constant", Kind::constant},
                                                  {"uniform", Kind::uniform},
                                                  {"log_uniform", Kind::log_uniform},
                                                  {"normal", Kind::normal},
                                                  {"list", Kind::list}}};
  std::string found;
  for (const auto& [name, kind] : kinds) {
    if (!section.has(name)) continue;
    section.allow({name});
    if (!found.empty())
      section.wrong(name, "conflicts with " + found + ": give exactly one distribution");
    found = name;
    draw.distribution.kind = kind;
  }
  switch (draw.distribution.kind) {
    case Kind::uniform:
      return read_ends(section, "uniform", any_number.min, draw.distribution);
    case Kind::log_uniform:
      return read_ends(section, "log_uniform", 1e-300, draw.distribution);
    case Kind::normal:
      return read_normal(section, draw.distribution);
    case Kind::list:
      draw.values = read_list(section, draw.distribution);
      return;
    case Kind::constant:
      break;
  }
  draw.distribution.first = section.required_number("constant", any_number);
}

Draw read_draw(Section section) {
  Draw draw;
  draw.keys = section.texts("keys");
  draw.name = section.text("name", draw.keys.empty() ? "" : draw.keys.front());
  if (draw.name.empty())
    section.wrong("keys", "is missing, and so is name: give at least one of them");
  if (draw.name.find_first_of(separators) != std::string::npos)
    section.wrong("name", "must not contain a comma, quote, bar or line break");
  read_distribution(section, draw);
  draw.times = section.texts("times");
  draw.over = section.texts("over");
  if (draw.distribution.kind == Distribution::Kind::list &&
      !(draw.times.empty() && draw.over.empty()))
    section.wrong("list", "is used as it is: it cannot be combined with times or over");
  draw.group = section.text("group", "");
  draw.correlation = section.number("correlation", 1.0, {-1.0, 1.0});
  if (draw.group.empty() && section.has("correlation"))
    section.wrong("correlation", "needs group: the draws to correlate with");
  section.finish();
  return draw;
}

std::vector<Draw> read_draws(Section& top) {
  // Far more than a study needs, and far fewer than a Sobol sequence has.
  constexpr std::size_t max_draws = 500;
  std::vector<Draw> draws;
  for (Section& section : top.sections("draw")) {
    draws.push_back(read_draw(section));
    const auto twice = std::count_if(draws.begin(), draws.end(), [&](const Draw& other) {
      return other.name == draws.back().name;
    });
    if (twice > 1 && !draws.back().name.empty())
      section.wrong("name", draws.back().name + " is drawn twice");
    if (draws.size() > max_draws) section.wrong("name", "there are more than 500 draws");
  }
  return draws;
}

std::vector<Goal> read_goals(Section section) {
  const std::size_t faults = *find_quantity("faults");
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < quantity_count; ++i) {
    const std::string_view name = quantity(i).name;
    const auto max = i == faults ? section.number(name, 0.0, any_number)
                                 : section.optional_number(name, any_number);
    if (max && section.has(name)) goals.push_back({i, *max});
  }
  if (!section.has("faults")) goals.push_back({faults, 0.0});
  section.finish();
  return goals;
}

/// A scenario from its own file, with the problems of that file.
toml::table read_scenario_file(const std::string& path, Errors& problems) {
  Diagnostics diagnostics(path);
  toml::table scenario = config::parse(config::read_text(path, diagnostics), diagnostics);
  problems = diagnostics.problems();
  return scenario;
}

/// The scenario, with the study's changes laid over it.
toml::table read_base(Section& study, const std::string& name, const std::filesystem::path& beside,
                      const toml::table& document, Errors& problems) {
  toml::table base;
  if (const auto builtin = builtin_scenario(name)) {
    Diagnostics none(name);
    base = config::parse(std::string(*builtin), none);
  } else if (name.find_first_of("./") == std::string::npos) {
    const auto names = names_of(builtin_scenarios());
    study.wrong("scenario", "is not a built-in scenario; " +
                                suggestion_or_all(name, names, "the built-in scenarios are"));
  } else {
    base = read_scenario_file((beside / name).string(), problems);
  }
  if (const toml::table* changes = document.get_as<toml::table>("scenario"))
    apply_changes(base, toml::table(*changes));
  return base;
}

std::vector<compare::Document> read_contenders(Section& study,
                                               const std::filesystem::path& beside) {
  std::vector<std::string> names = study.texts("controllers");
  if (names.empty()) return {{"scenario", ""}};
  for (std::string& name : names) {
    if (name.find_first_of("./") != std::string::npos) name = (beside / name).string();
  }
  auto found = compare::find_controllers(names);
  if (found) return *found;
  const std::string why = found.error().text();
  study.wrong("controllers", why.substr(0, why.find_last_not_of('\n') + 1));
  return {};
}

std::uint32_t definition_of(const toml::table& document, const Study& study) {
  std::ostringstream text;
  text << document << study.scenario;
  for (const compare::Document& one : study.contenders) {
    config::Diagnostics none_left(one.name);
    text << '\n' << one.name << '\n' << config::parse(one.text, none_left);
  }
  // Only a Latin hypercube's points depend on the number of runs.
  if (study.sampling == Sampling::latin_hypercube) text << study.runs;
  return storage::crc32(text.str());
}

void read_head(Section& section, Study& study) {
  study.runs = section.integer("runs", study.runs, 1, max_runs);
  study.sampling = section.choice("sampling", study.sampling, sampling_names);
  study.seed = static_cast<std::uint64_t>(section.integer("seed", 1, 0, 2147483647));
  study.known_to = section.number("known_to", 0.0, {0.0, 0.5});
  if (study.known_to > 0.0 && study.sampling == Sampling::latin_hypercube) {
    section.wrong(
        "known_to",
        "a Latin hypercube is valid only when all its runs are complete; use sobol or random");
  }
}

void read_window(Section& section, Study& study) {
  const double duration_s = study.scenario["simulation"]["duration_s"].value_or(200.0);
  const auto window =
      section.numbers("window_s", {duration_s / 2.0, duration_s}, {0.0, duration_s}, 2, 2);
  study.window = {window[0], window[1]};
  if (!(window[0] < window[1]))
    section.wrong("window_s", "the second value must be greater than the first");
}

/// Removes what does not affect a single run: the number of runs, and the goals.
void keep_what_makes_a_run(toml::table& document) {
  document.erase("goals");
  if (toml::table* study = document.get_as<toml::table>("study")) {
    study->erase("runs");
    study->erase("known_to");
  }
}

}  // namespace

tl::expected<Study, Errors> read_study(const std::string& path, std::int64_t runs,
                                       config::KeyList* keys) {
  Diagnostics diagnostics(path, keys);
  const auto& builtin = builtin_studies();
  const auto found = std::ranges::find(builtin, path, &BuiltinScenario::name);
  const std::string text =
      found != builtin.end() ? std::string(found->text) : config::read_text(path, diagnostics);
  toml::table document = config::parse(text, diagnostics);
  if (!diagnostics.empty()) {
    if (path.find_first_of("./") == std::string::npos) {
      diagnostics.add(0, "",
                      "and no built-in study has that name; " +
                          suggestion_or_all(path, names_of(builtin), "the built-in studies are"));
    }
    return tl::unexpected(diagnostics.problems());
  }
  if (document.empty()) {
    diagnostics.add(0, "", "is empty: a study has at least one of [study], [[draw]], [goals]");
    return tl::unexpected(diagnostics.problems());
  }
  Study study;
  study.name = std::filesystem::path(path).stem().string();
  if (text.starts_with('#')) study.about = description({"", text});
  const std::filesystem::path beside = std::filesystem::path(path).parent_path();
  Section top(&document, "", diagnostics);
  top.allow({"scenario"});
  Section head = top.section("study");
  read_head(head, study);
  if (runs > 0) study.runs = runs;
  Errors of_scenario;
  study.base = head.text("scenario", "sine");
  study.scenario = read_base(head, study.base, beside, document, of_scenario);
  if (document.contains("scenario") && !document.get("scenario")->is_table()) {
    top.wrong("scenario",
              "must be tables, such as [scenario.plant]; name the scenario in study.scenario");
  }
  read_window(head, study);
  study.contenders = read_contenders(head, beside);
  head.finish();
  study.draws = read_draws(top);
  study.goals = read_goals(top.section("goals"));
  top.finish();
  of_scenario.insert(of_scenario.end(), diagnostics.problems().begin(),
                     diagnostics.problems().end());
  if (!of_scenario.empty()) return tl::unexpected(of_scenario);
  keep_what_makes_a_run(document);
  study.definition = definition_of(document, study);
  return study;
}

}  // namespace supercoil::host_sim::campaign
