#include "supervisor/verdict.hpp"

namespace supercoil {

void Verdict::take(Fault fault) {
  if (fault_ == Fault::none) fault_ = fault;
  if (board_fault_ == Fault::none && info(fault)->scope == Scope::board) board_fault_ = fault;
}

}  // namespace supercoil
