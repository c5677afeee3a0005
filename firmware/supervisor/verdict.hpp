// Where all detectors report; the first that trips in a tick is the tick's fault.
#pragma once

#include <array>
#include <cstddef>

#include "supervisor/detectors/margin.hpp"
#include "supervisor/fault.hpp"

namespace supercoil {

/// Knows each detector's margin, and which fault a tick has. Detectors report in the order of how
/// near they are to the cause: a stale sensor before what a stale sensor makes look wrong.
class Verdict {
 public:
  static constexpr std::size_t faults = 96;  ///< numbers below this

  void begin() { fault_ = Fault::none; }
  /// margin outlives the verdict: it is the detector's own.
  void note(Fault fault, bool trips, const detectors::Margin& margin) {
    margins_[static_cast<std::size_t>(fault)] = &margin;
    if (trips && fault_ == Fault::none) fault_ = fault;
  }
  Fault fault() const { return fault_; }
  /// As of the last tick at which it judged; nothing used before that.
  detectors::Margin margin(Fault fault) const {
    const detectors::Margin* known = margins_[static_cast<std::size_t>(fault)];
    return known == nullptr ? detectors::Margin{} : *known;
  }

 private:
  Fault fault_ = Fault::none;
  std::array<const detectors::Margin*, faults> margins_{};
};

}  // namespace supercoil
