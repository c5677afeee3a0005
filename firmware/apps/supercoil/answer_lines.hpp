// What a person or a script answers, line by line, while something else must go on.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace supercoil::operating {

/// Of one thread, and of one file. Reads what is there and never waits longer than asked.
class AnswerLines {
 public:
  explicit AnswerLines(int file) : file_(file) {}

  /// The next line, without its end; empty: none came within that time, or none will.
  std::optional<std::string> wait(std::chrono::milliseconds longest);
  /// Nobody will answer any more.
  bool ended() const { return ended_ && read_.empty(); }

 private:
  std::optional<std::string> take_line();

  int file_;
  std::string read_;
  bool ended_ = false;
};

}  // namespace supercoil::operating
