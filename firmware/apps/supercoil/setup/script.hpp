// What a person would answer, in a file.
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

/// To what the steps of a running board ask, by a question's key.
class ScriptedAnswers {
 public:
  /// path: of the file, for errors.
  explicit ScriptedAnswers(std::string path = "") : path_(std::move(path)) {}

  /// values: each time that it is asked the next one, and in the end the last one.
  void add(const std::string& table, std::string_view key, std::vector<double> values);
  /// Answers a step that needs a person; its table has the step's name.
  bool has_table(std::string_view table) const;
  /// Empty: it does not answer that. The error: what is allowed, as the board is now.
  std::optional<Operator::OrWhy> next(const Question& question);

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
  MuscleAnswers muscle;                       ///< a key that is not there is not answered
  std::array<int, questions.size()> lines{};  ///< of those that are
  ScriptedAnswers answers;
};
/// The tables of a file, all but [muscle] may be absent. The error is whole lines.
Result<Script> read_script(const std::string& path);

}  // namespace supercoil::operating
