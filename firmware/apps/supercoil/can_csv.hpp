// A candump log as CSV.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

#include "can/codec.hpp"
#include "recorder/recording.hpp"

namespace supercoil::operating {

/// What of a log is wanted.
struct CanSelection {
  double from_s;        ///< of the log's own times
  double to_s;          ///< included
  int node = 0;         ///< 0: all
  std::string message;  ///< empty: all
};

bool is_wanted(const CanSelection& selection, const can::Decoded& decoded, double time_s);

/// Of all messages: a row for each value, "time_s,node,message,signal,value,unit"; what is not
/// available has none. Of one message: a row a frame, a column a signal; what is not available is
/// empty. Values with names are written by name. The message must be one of the protocol's. Returns
/// how many rows it wrote; the error is the writer's.
Result<std::size_t> can_to_csv(const std::vector<hal::CanFrame>& frames,
                               const CanSelection& selection, const recorder::Sink& write);

}  // namespace supercoil::operating
