// Talks to the supercoild of this board.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "supercoil/hal/error.hpp"

namespace supercoil::operating {

/// Where supercoild listens by default.
inline constexpr const char* default_socket = "/run/supercoil/commands";

/// " --socket PATH", as a command takes it; empty: path is the default.
inline std::string socket_words(const std::string& path) {
  return path == default_socket ? "" : " --socket " + path;
}

/// Whether supercoild answers that the line itself is wrong.
inline bool is_wrong_line(std::string_view answer) {
  return answer.starts_with("wrong: ");
}

/// The answer as a person is told it.
inline std::string unmarked(const std::string& answer) {
  return is_wrong_line(answer) ? answer.substr(answer.find(' ') + 1) : answer;
}

/// The socket for local commands (docs/running.md). Move-only.
class BoardSocket {
 public:
  static Result<BoardSocket> open(const std::string& path);
  BoardSocket(BoardSocket&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  BoardSocket& operator=(BoardSocket&&) = delete;
  BoardSocket(const BoardSocket&) = delete;
  BoardSocket& operator=(const BoardSocket&) = delete;
  ~BoardSocket();

  /// Sends one line and receives one answer, within 2 s.
  Result<std::string> ask(const std::string& line) const;

 private:
  explicit BoardSocket(int file) : file_(file) {}
  int file_;
};

}  // namespace supercoil::operating
