// What a trace tells of each tick, column by column.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "supercoil/control/joint/lever.hpp"

#include "runner/simulation.hpp"

namespace supercoil::host_sim {

struct TraceRow {
  const TickRecord& record;
  const std::optional<control::Estimate>& estimate;
  const control::Lever& lever;  ///< of a joint
};

/// Of numbers or of words: the other one is null.
struct TraceColumn {
  std::string_view name;
  /// Empty: there is nothing to tell.
  std::optional<double> (*number)(const TraceRow&) = nullptr;
  std::string_view (*word)(const TraceRow&) = nullptr;
};

/// joint: with its angles and, of one of two muscles, those of the antagonist, which its rows have
/// to have. Null: there is none.
std::span<const TraceColumn> trace_columns(const JointConditions* joint);

}  // namespace supercoil::host_sim
