// What can be asked of a board before anybody heats anything.
#pragma once

#include <functional>
#include <string>

namespace supercoil::hal {

/// One finding: what was looked at, how it is, and what to do when it is not well.
struct Finding {
  enum class Verdict { good, doubtful, bad };
  std::string subject;
  Verdict verdict = Verdict::good;
  std::string found;
  std::string remedy;  ///< empty when good
};

/// Probes of one kind of board. Runs only while no daemon holds the board; may block and allocate;
/// never turns anything on.
class BoardCheck {
 public:
  BoardCheck() = default;
  BoardCheck(const BoardCheck&) = delete;
  BoardCheck& operator=(const BoardCheck&) = delete;
  virtual ~BoardCheck() = default;

  /// Tells every finding as it is made.
  virtual void run(const std::function<void(const Finding&)>& tell) = 0;
};

}  // namespace supercoil::hal
