// What a trace tells of each tick, column by column.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

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

/// Of a joint with its angles and, of one of two muscles, those of the antagonist; of a bundle with
/// those of all. The rows have to have them. conditions: null: of a muscle by itself.
std::vector<TraceColumn> trace_columns(const Conditions* conditions);

}  // namespace supercoil::host_sim
