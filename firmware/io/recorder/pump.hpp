// From the loop's ring into the recorder.
#pragma once

#include "recorder/flight_recorder.hpp"

namespace supercoil::recorder {

/// Moves the ring's rows into the recorder, in the recorder's thread. Loop is supercoil::Loop, or
/// anything with its take(Row&). now: read before the call. Call it every 100 ms or so; the ring
/// holds 1 s. Returns the number of rows.
template <class Loop>
std::size_t pump(Loop& loop, FlightRecorder& recorder, hal::Time now) {
  std::size_t count = 0;
  for (Row row; loop.take(row); ++count)
    recorder.add(row);
  recorder.poll(now);
  return count;
}

}  // namespace supercoil::recorder
