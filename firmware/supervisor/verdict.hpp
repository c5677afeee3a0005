// Where all detectors report; the first that trips in a tick is the tick's fault.
#pragma once

#include <array>
#include <cstddef>

#include "supervisor/detectors/margin.hpp"
#include "supervisor/fault.hpp"

namespace supercoil {

/// Keeps each detector's margin, and which fault a tick has. Detectors report in the order of how
/// near they are to the cause: a stale sensor before what a stale sensor makes look wrong.
class Verdict {
 public:
  static constexpr std::size_t faults = 96;  ///< numbers below this

  void begin() { fault_ = Fault::none; }
  void note(Fault fault, bool trips, const detectors::Margin& margin) {
    margins_[static_cast<std::size_t>(fault)] = margin;
    if (trips && fault_ == Fault::none) fault_ = fault;
  }
  Fault fault() const { return fault_; }
  const detectors::Margin& margin(Fault fault) const {
    return margins_[static_cast<std::size_t>(fault)];
  }

 private:
  Fault fault_ = Fault::none;
  std::array<detectors::Margin, faults> margins_{};
};

}  // namespace supercoil
