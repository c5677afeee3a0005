// The columns of a trace.
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

/// A column of numbers or of words; the other function is null.
struct TraceColumn {
  std::string_view name;
  /// Empty: no value.
  std::optional<double> (*number)(const TraceRow&) = nullptr;
  std::string_view (*word)(const TraceRow&) = nullptr;
};

/// A joint adds its angles and, if it has two muscles, the antagonist's columns; a bundle adds
/// those of all its muscles. The rows must have them. conditions: null: of a muscle by itself.
std::vector<TraceColumn> trace_columns(const Conditions* conditions);

}  // namespace supercoil::host_sim
