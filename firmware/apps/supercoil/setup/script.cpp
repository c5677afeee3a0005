#include "apps/supercoil/setup/script.hpp"

#include <algorithm>
#include <array>

#include "config/toml_file.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

/// For the steps that need a person: answers that some board could allow. Each step checks what its
/// own board allows.
struct StepKey {
  const char* table;
  std::string_view key;
  config::Range allowed;
  std::size_t numbers;
};
constexpr std::array step_keys{
    StepKey{"senses", "power_W", {1e-3, 1e3}, 1}, StepKey{"senses", "supply_V", {0.1, 60.0}, 2},
    StepKey{"senses", "current_A", {1e-5, 1e3}, 2}, StepKey{"scale", "place_mm", {1e-3, 1e4}, 1},
    StepKey{"limits", "stop_mm", {0.01, 1e4}, 1}};

void read_step(const char* table, config::Section& root, ScriptedAnswers& answers) {
  root.allow({table});
  if (!root.has(table)) return;
  config::Section section = root.section(table);
  for (const StepKey& known : step_keys) {
    if (std::string_view(known.table) != table) continue;
    answers.add(table, known.key,
                known.numbers == 1 ? std::vector{section.required_number(known.key, known.allowed)}
                                   : section.required_numbers(known.key, known.allowed,
                                                              known.numbers, known.numbers));
  }
  section.finish();
}

Nameplate read_nameplate(config::Section section) {
  Nameplate nameplate;
  for (std::size_t i = 0; i < nameplate_questions.size(); ++i) {
    const Question& q = nameplate_questions[i];
    nameplate.set(i, std::isnan(q.fallback) ? section.required_number(q.key, q.allowed)
                                            : section.number(q.key, q.fallback, q.allowed));
  }
  section.finish();
  return nameplate;
}

}  // namespace

void ScriptedAnswers::add(const std::string& table, std::string_view key,
                          std::vector<double> values) {
  by_key_[std::string(key)] = {table, std::move(values)};
}

bool ScriptedAnswers::has_table(std::string_view table) const {
  return std::ranges::any_of(by_key_, [&](const auto& one) { return one.second.table == table; });
}

std::optional<Operator::Answer> ScriptedAnswers::next(const Question& question) {
  const auto found = by_key_.find(question.key);
  if (found == by_key_.end()) return std::nullopt;
  Answers& answers = found->second;
  const double value = answers.values.at(answers.next);
  answers.next = std::min(answers.next + 1, answers.values.size() - 1);
  if (question.allows(value)) return value;
  return failure(path_ + ": " + answers.table + "." + std::string(question.key) + " = " +
                 number_text(value, 9) + ": must be " + range_text(question.allowed) +
                 " here: " + std::string(question.text));
}

Result<Script> read_script(const std::string& path) {
  config::Diagnostics diagnostics(path);
  const std::string text = config::read_text(path, diagnostics);
  Script script;
  script.answers = ScriptedAnswers(path);
  if (diagnostics.empty()) {
    const toml::table document = config::parse(text, diagnostics);
    config::Section root(&document, "", diagnostics);
    config::Section muscle = root.section("muscle");
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const Question& q = questions[i];
      // Absent keys are known too, so that a misspelt key can be matched to one.
      if (muscle.has(q.key)) {
        script.muscle.set(i, muscle.number(q.key, NAN, q.allowed));
        script.lines.at(i) = static_cast<int>(muscle.table()->get(q.key)->source().begin.line);
      } else {
        muscle.allow({q.key});
      }
    }
    script.answers.add("muscle", take_gains.key,
                       {muscle.number(take_gains.key, take_gains.fallback, take_gains.allowed)});
    script.answers.add("muscle", reset_fault.key,
                       {muscle.number(reset_fault.key, 0.0, reset_fault.allowed)});
    muscle.finish();
    if (root.has("nameplate")) {
      script.nameplate = read_nameplate(root.section("nameplate"));
    } else {
      root.allow({"nameplate"});
    }
    for (const char* table : {"senses", "scale", "limits"})
      read_step(table, root, script.answers);
    root.finish();
  }
  if (!diagnostics.empty()) return failure(config::to_text(diagnostics.problems()));
  return script;
}

}  // namespace supercoil::operating
