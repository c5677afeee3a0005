// A muscle that is heated while a person is asked.
#pragma once

#include <chrono>
#include <string>

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::operating {

/// Makes one channel cold again however its step ends.
class Heated {
 public:
  /// The error: a command was not obeyed, or a person ended it.
  using Done = Operator::Done;

  /// All outlive it.
  Heated(BoardLink& board, const std::string& channel, Operator& user);
  Heated(const Heated&) = delete;
  Heated& operator=(const Heated&) = delete;
  ~Heated();

  Done ask(const std::string& what);
  /// Also renews the command: a command to heat expires.
  Done heat(double power_W);
  Done hold(double power_W, std::chrono::milliseconds time);
  double time_s() const { return board_.time_s(); }

 private:
  Done ask_channel(const std::string& channel, const std::string& what);

  BoardLink& board_;
  const std::string& channel_;
  std::string heated_by_;  ///< the channel that leads its bundle; else itself
  Operator& user_;
};

}  // namespace supercoil::operating
