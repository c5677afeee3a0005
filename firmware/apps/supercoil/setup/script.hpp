// A person's answers, in a file.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/setup/muscle_answers.hpp"
#include "apps/supercoil/setup/nameplate.hpp"

namespace supercoil::operating {

/// Answers for the steps of a running board, by a question's key.
class ScriptedAnswers {
 public:
  /// path: of the file, for errors.
  explicit ScriptedAnswers(std::string path = "") : path_(std::move(path)) {}

  /// values: one for each time that the question is asked; the last one repeats.
  void add(const std::string& table, std::string_view key, std::vector<double> values);
  /// Whether it answers a step that needs a person; its table has the step's name.
  bool has_table(std::string_view table) const;
  /// Empty: the script has no answer. The error: what the board allows now.
  std::optional<Operator::Answer> next(const Question& question);

 private:
  struct Answers {
    std::string table;
    std::vector<double> values;
    std::size_t next = 0;
  };
  std::string path_;
  std::map<std::string, Answers, std::less<>> by_key_;
};

struct Script {
  Nameplate nameplate;
  MuscleAnswers muscle;                       ///< an absent key is not answered
  std::array<int, questions.size()> lines{};  ///< of the answered ones
  ScriptedAnswers answers;
};
/// Reads the tables of a file; all but [muscle] may be absent. The error consists of whole lines.
Result<Script> read_script(const std::string& path);

}  // namespace supercoil::operating
