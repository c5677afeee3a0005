#include "compare/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

#include "compare/plan.hpp"

namespace supercoil::host_sim::compare {

namespace {

std::size_t place(const std::vector<std::string>& order, const std::string& name) {
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), name) - order.begin());
}

std::string csv_number(double value) {
  if (std::isnan(value)) return {};
  std::array<char, 32> text{};
  constexpr int digits = 6;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, digits)
                       .ptr;
  return {text.data(), end};
}

}  // namespace

std::vector<TableRow> table_of(const Results& results) {
  std::vector<TableRow> rows;
  for (auto first = results.begin(); first != results.end();) {
    TableRow row{first->first.controller, first->first.disturbance, first->first.arithmetic, {}, 0};
    std::array<std::vector<double>, measures.size()> values;
    auto next = first;
    for (; next != results.end() &&
           std::tie(next->first.controller, next->first.disturbance, next->first.arithmetic) ==
               std::tie(row.controller, row.disturbance, row.arithmetic);
         ++next) {
      row.faults += next->second.fault.empty() ? 0 : 1;
      for (std::size_t i = 0; i < measures.size(); ++i) {
        if (!std::isnan(next->second.values[i])) values[i].push_back(next->second.values[i]);
      }
    }
    for (std::size_t i = 0; i < measures.size(); ++i) {
      if (!values[i].empty()) row.statistics[i] = statistics_of(values[i]);
    }
    rows.push_back(std::move(row));
    first = next;
  }
  const auto controllers = default_controllers();
  const auto disturbances = default_disturbances();
  std::stable_sort(rows.begin(), rows.end(), [&](const TableRow& a, const TableRow& b) {
    const auto rank = [&](const TableRow& row) {
      return std::pair(place(disturbances, row.disturbance), place(controllers, row.controller));
    };
    return rank(a) < rank(b);
  });
  return rows;
}

std::string to_csv(const std::vector<TableRow>& table) {
  std::string csv =
      "# ci95: confidence interval of the mean over the seeds, 95 %, Student's t\n"
      "controller,disturbance,arithmetic,measure,runs,mean,ci95_low,ci95_high,worst,faults,goal,"
      "met\n";
  for (const TableRow& row : table) {
    for (std::size_t i = 0; i < measures.size(); ++i) {
      if (!row.statistics[i]) continue;
      const Statistics& s = *row.statistics[i];
      const auto goal = goal_of(row, measures[i].name);
      csv += row.controller + "," + row.disturbance + "," + row.arithmetic + "," +
             std::string(measures[i].name) + "," + std::to_string(s.runs) + "," +
             csv_number(s.mean) + "," + csv_number(s.mean - s.half_width) + "," +
             csv_number(s.mean + s.half_width) + "," + csv_number(s.worst) + "," +
             std::to_string(row.faults) + "," + (goal ? csv_number(*goal) : "") + "," +
             (goal ? (s.worst <= *goal ? "yes" : "no") : "") + "\n";
    }
  }
  return csv;
}

}  // namespace supercoil::host_sim::compare
