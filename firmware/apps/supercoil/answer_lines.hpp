// A person's or a script's answers, line by line, without blocking other work.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace supercoil::operating {

/// Used by one thread, for one file. Reads what is there and never waits longer than asked.
class AnswerLines {
 public:
  explicit AnswerLines(int file) : file_(file) {}

  /// The next line, without its end; empty: none came within that time, or none will come.
  std::optional<std::string> wait(std::chrono::milliseconds timeout);
  /// Whether no more answers can come.
  bool ended() const { return ended_ && read_.empty(); }

 private:
  std::optional<std::string> take_line();

  int file_;
  std::string read_;
  bool ended_ = false;
};

}  // namespace supercoil::operating
