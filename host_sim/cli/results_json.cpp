#include "cli/results_json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "apps/common/problems_json.hpp"
#include "cli/commands.hpp"
#include "text/program_version.hpp"

namespace supercoil::host_sim {

namespace {

using nlohmann::ordered_json;

/// Incremented when a key is renamed or its meaning changes.
constexpr int schema_version = 1;

std::optional<std::string_view> next_line(std::string_view& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// Values that are not finite become null: JSON has no such number.
ordered_json value_of(std::string_view cell) {
  if (cell == "yes" || cell == "no") return cell == "yes";
  std::int64_t whole = 0;
  const char* end = cell.data() + cell.size();
  if (const auto read = std::from_chars(cell.data(), end, whole); read.ptr == end && !cell.empty())
    return whole;
  double value = 0.0;
  const auto read = std::from_chars(cell.data(), end, value);
  if (cell.empty() || read.ptr != end || !std::isfinite(value)) return nullptr;
  return value;
}

void print_problems(const Errors& problems) {
  std::puts(
      problems_json(problems).dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
}

}  // namespace

ordered_json rows_json(std::string_view csv, const std::vector<std::string_view>& text_columns) {
  ordered_json rows = ordered_json::array();
  std::vector<std::string_view> columns;
  while (const auto line = next_line(csv)) {
    if (line->starts_with('#')) continue;
    const auto cells = cells_of(*line);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    ordered_json row = ordered_json::object();
    for (std::size_t i = 0; i < std::min(columns.size(), cells.size()); ++i) {
      const bool is_text = std::ranges::find(text_columns, columns[i]) != text_columns.end();
      row[std::string(columns[i])] = is_text ? ordered_json(cells[i]) : value_of(cells[i]);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

ordered_json entries_json(const std::vector<BuiltinScenario>& entries) {
  ordered_json list = ordered_json::array();
  for (const BuiltinScenario& entry : entries)
    list.push_back({{"name", entry.name}, {"description", description(entry)}});
  return list;
}

void print_results(const ordered_json& results) {
  ordered_json all{{"schema_version", schema_version}, {"program_version", program_version()}};
  all.update(results);
  std::puts(all.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
}

int refuse(bool json, int status, const std::string& message) {
  if (!json) return fail(status, message);
  print_problems({{"", 0, "", message}});
  return status;
}

int refuse_problems(bool json, const Errors& problems) {
  if (json) {
    print_problems(problems);
  } else {
    std::fputs(config::to_text(problems).c_str(), stderr);
  }
  return exit_wrong_input;
}

int refuse_lines(bool json, const std::string& lines) {
  if (!json) {
    std::fputs(lines.c_str(), stderr);
    return exit_wrong_input;
  }
  Errors problems;
  std::string_view rest(lines);
  while (const auto line = next_line(rest))
    problems.push_back({"", 0, "", std::string(*line)});
  return refuse_problems(json, problems);
}

}  // namespace supercoil::host_sim
