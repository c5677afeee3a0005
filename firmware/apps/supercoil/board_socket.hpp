// Talks to the supercoild of this board.
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace supercoil::operating {

/// The socket for local commands (docs/running.md). Move-only.
class BoardSocket {
 public:
  static tl::expected<BoardSocket, std::string> open(const std::string& path);
  BoardSocket(BoardSocket&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  BoardSocket& operator=(BoardSocket&&) = delete;
  BoardSocket(const BoardSocket&) = delete;
  BoardSocket& operator=(const BoardSocket&) = delete;
  ~BoardSocket();

  /// One line there, one answer back, within 2 s.
  tl::expected<std::string, std::string> ask(const std::string& line) const;

 private:
  explicit BoardSocket(int file) : file_(file) {}
  int file_;
};

}  // namespace supercoil::operating
