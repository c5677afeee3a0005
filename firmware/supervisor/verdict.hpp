// Where all detectors report; the first that trips in a tick is the tick's fault.
#pragma once

#include <array>
#include <cstddef>

#include "supervisor/detectors/margin.hpp"
#include "supervisor/fault.hpp"

namespace supercoil {

/// Knows each detector's margin, and which fault a tick has. Detectors report in the order of how
/// near they are to the cause: a stale sensor before what a stale sensor makes look wrong. A fault
/// of the whole board is kept apart, so that no other can hide it.
class Verdict {
 public:
  static constexpr std::size_t faults = 96;  ///< numbers below this

  void begin() { fault_ = board_fault_ = Fault::none; }
  /// margin outlives the verdict: it is the detector's own.
  void note(Fault fault, bool trips, const detectors::Margin& margin) {
    margins_[static_cast<std::size_t>(fault)] = &margin;
    if (trips) take(fault);
  }
  /// The first of this tick, of either scope.
  Fault fault() const { return fault_; }
  /// The first of this tick that concerns the whole board.
  Fault board_fault() const { return board_fault_; }
  /// Whether this verdict's detectors judge that fault.
  bool judges(Fault fault) const { return margins_[static_cast<std::size_t>(fault)] != nullptr; }
  /// As of the last tick at which it judged; nothing used before that.
  detectors::Margin margin(Fault fault) const {
    return judges(fault) ? *margins_[static_cast<std::size_t>(fault)] : detectors::Margin{};
  }

 private:
  void take(Fault fault) {
    if (fault_ == Fault::none) fault_ = fault;
    if (board_fault_ == Fault::none && info(fault)->scope == Scope::board) board_fault_ = fault;
  }

  Fault fault_ = Fault::none;
  Fault board_fault_ = Fault::none;
  std::array<const detectors::Margin*, faults> margins_{};
};

}  // namespace supercoil
