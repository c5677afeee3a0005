// Where all detectors report; the first that trips in a tick is the tick's fault.
#pragma once

#include <array>
#include <cstddef>

#include "supervisor/detectors/margin.hpp"
#include "supervisor/fault.hpp"

namespace supercoil {

/// Knows each detector's margin and the fault of a tick. Detectors report in order of closeness to
/// the cause: a stale sensor before its consequences. A fault of the whole board is kept
/// separately, so that no other can hide it.
class Verdict {
 public:
  static constexpr std::size_t faults = 96;  ///< numbers below this

  void begin() { fault_ = board_fault_ = Fault::none; }
  /// detector must outlive the verdict, which asks it for its margin.
  void note(Fault fault, bool trips, const detectors::Detector& detector) {
    detectors_[static_cast<std::size_t>(fault)] = &detector;
    if (trips) take(fault);
  }
  /// The first of this tick, of either scope.
  Fault fault() const { return fault_; }
  /// The first of this tick that concerns the whole board.
  Fault board_fault() const { return board_fault_; }
  /// Whether this verdict's detectors judge that fault.
  bool judges(Fault fault) const { return detectors_[static_cast<std::size_t>(fault)] != nullptr; }
  /// As of the last tick at which its detector judged; before that, none of the limit is used.
  detectors::Margin margin(Fault fault) const {
    return judges(fault) ? detectors_[static_cast<std::size_t>(fault)]->margin()
                         : detectors::Margin{};
  }

 private:
  /// Not inline: thirty copies of rarely run code would push the tick out of the cache.
  void take(Fault fault);

  Fault fault_ = Fault::none;
  Fault board_fault_ = Fault::none;
  std::array<const detectors::Detector*, faults> detectors_{};
};

}  // namespace supercoil
