// A candump log as CSV.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

#include "can/codec.hpp"
#include "recorder/recording.hpp"

namespace supercoil::operating {

/// Selects a part of a log.
struct CanSelection {
  double from_s;        ///< in the log's own time
  double to_s;          ///< included
  int node = 0;         ///< 0: all
  std::string message;  ///< empty: all
};

bool is_wanted(const CanSelection& selection, const can::Decoded& decoded, double time_s);

/// For all messages: a row for each value, "time_s,node,message,signal,value,unit"; a value that is
/// not available has no row. For one message: a row a frame, a column a signal; empty: not
/// available. Named values are written as names. The message must be one of the protocol's. Returns
/// the number of rows written; the error is the writer's.
Result<std::size_t> can_to_csv(const std::vector<hal::CanFrame>& frames,
                               const CanSelection& selection, const recorder::Sink& write);

}  // namespace supercoil::operating
