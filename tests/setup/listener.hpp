// An operator of setup for tests.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "apps/supercoil/setup/operator.hpp"
#include "apps/supercoil/setup/script.hpp"

namespace supercoil::test {

/// Nobody is there, at most a script; keeps everything that setup says.
class Listener final : public operating::Operator {
 public:
  Listener() = default;
  explicit Listener(operating::ScriptedAnswers script) : script_(std::move(script)) {}

  void show(const std::string& line) override { output_ += line + "\n"; }
  void show_progress(const std::string&, double) override {}
  bool sees_progress() const override { return false; }
  bool interrupted() const override { return false; }
  Answer ask(const operating::Question& question, const std::function<Done()>&) override {
    return scripted(question).value_or(failure("no answer: the input has ended"));
  }
  std::optional<Answer> scripted(const operating::Question& question) override {
    return script_.next(question);
  }
  /// What was said since the last call.
  std::string take() { return std::exchange(output_, {}); }

 private:
  operating::ScriptedAnswers script_;
  std::string output_;
};

}  // namespace supercoil::test
