// MCAP export of what `supercoil log` reads: JSON values by name; null: not available.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/supercoil/can_csv.hpp"
#include "apps/supercoil/mcap/writer.hpp"
#include "recorder/recording.hpp"

namespace supercoil::operating::mcap {

/// Topics /channel_1 to /channel_16 have the rows' quantities and time_s, relative to the fault;
/// /faults has each fault that latched or was reset. Times are the board's clock. Metadata
/// "recording" holds the header.
Written from_recording(const recorder::Recording& recording, const recorder::Sink& write);

/// Topic /node_1/Status and so on for each message of each node; times are the log's. Returns the
/// number of messages written.
Result<std::size_t> from_can_log(const std::vector<hal::CanFrame>& frames,
                                 const CanSelection& selection, const recorder::Sink& write);

}  // namespace supercoil::operating::mcap
