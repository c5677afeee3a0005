// A converter's input.
#pragma once

#include <cstdint>

#include "supercoil/hal/clock.hpp"
#include "supercoil/hal/status.hpp"

namespace supercoil::hal {

/// A conversion. Counts are raw: only board/measurement.hpp turns them into units.
struct Sample {
  std::int32_t counts = 0;
  Time taken{};  ///< when it was converted, on the board's clock
  Status status = Status::not_ready;
};

/// One input. Owned by the board. latest() never blocks: a direct converter is read within 20 µs; a
/// buffered one gives the newest conversion that its bus's thread has exchanged, with the time when
/// it was taken. An old conversion keeps its time; the caller judges whether it is too old.
class AdcChannel {
 public:
  AdcChannel() = default;
  AdcChannel(const AdcChannel&) = delete;
  AdcChannel& operator=(const AdcChannel&) = delete;
  virtual ~AdcChannel() = default;

  /// The newest conversion, or the status that says why there is none.
  virtual Sample latest() = 0;
};

}  // namespace supercoil::hal
