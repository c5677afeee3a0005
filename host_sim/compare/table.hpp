// The results of all seeds together: compare.csv and a table to read.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/result.hpp"
#include "compare/statistics.hpp"

namespace supercoil::host_sim::compare {

/// A controller in an arithmetic, against one disturbance.
struct TableRow {
  std::string controller;
  std::string disturbance;
  std::string arithmetic;
  std::array<std::optional<Statistics>, measures.size()> statistics;
  std::int64_t faults = 0;  ///< runs in which one latched

  /// For tables: the arithmetic only where it is not double.
  std::string contender() const {
    return arithmetic == "double" ? controller : controller + " " + arithmetic;
  }
};

/// In the order of the built-in controllers and disturbances, others after them.
std::vector<TableRow> table_of(const Results& results);

/// controller,disturbance,arithmetic,measure,runs,mean,ci95_low,ci95_high,worst,goal,met.
std::string to_csv(const std::vector<TableRow>& table);
/// Markdown: one table per measure, mean ± half of the 95 % interval (worst), in µm and s.
std::string to_markdown(const std::vector<TableRow>& table);

/// The controller's goal, in the measure's unit; empty if none was set.
std::optional<double> goal_of(const TableRow& row, std::string_view measure);

}  // namespace supercoil::host_sim::compare
