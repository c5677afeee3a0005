// Setup on a terminal: lines, questions, Ctrl-C.
#pragma once

#include <cstdio>
#include <optional>
#include <utility>

#include <unistd.h>

#include "apps/common/progress.hpp"
#include "apps/supercoil/answer_lines.hpp"
#include "apps/supercoil/setup/operator.hpp"
#include "apps/supercoil/setup/script.hpp"

namespace supercoil::operating {

class TerminalOperator final : public Operator {
 public:
  explicit TerminalOperator(std::FILE* out) : out_(out) {}

  void show(const std::string& line) override;
  void show_progress(const std::string& what, double done) override;
  bool sees_progress() const override { return isatty(STDERR_FILENO) == 1; }
  bool interrupted() const override;
  /// Clears the progress line, so that the next message starts on an empty one.
  void end_progress() { progress_.reset(); }
  /// Questions that the script answers are no longer asked.
  void take(ScriptedAnswers answers) { script_ = std::move(answers); }
  std::optional<Answer> scripted(const Question& question) override;
  /// Allows three tries if standard input is not a terminal.
  Answer ask(const Question& question, const std::function<Done()>& meanwhile) override;

 private:
  Result<std::string> next_line(const std::function<Done()>& meanwhile);

  std::FILE* out_;
  ScriptedAnswers script_;
  AnswerLines answers_{STDIN_FILENO};
  std::string progress_of_;
  std::optional<Progress> progress_;
};

}  // namespace supercoil::operating
