// JSON output of the commands that end in tables: docs/json.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/diagnostics.hpp"
#include "scenario/builtin.hpp"

namespace supercoil::host_sim {

/// The rows of a CSV text without quotes, as objects with its columns as keys: text in the named
/// columns, numbers in all others, null for empty cells. "yes" and "no" become true and false.
nlohmann::ordered_json rows_json(std::string_view csv,
                                 const std::vector<std::string_view>& text_columns);

/// Each entry's name and description.
nlohmann::ordered_json entries_json(const std::vector<BuiltinScenario>& entries);

/// Prints the versions, with which every answer begins, and then the results.
void print_results(const nlohmann::ordered_json& results);

/// Reports an error: with json as JSON, like run --json, and nothing on standard error. Returns the
/// status.
int refuse(bool json, int status, const std::string& message);
/// The same for wrong input. Returns its status.
int refuse_problems(bool json, const Errors& problems);
/// One problem per line.
int refuse_lines(bool json, const std::string& lines);

}  // namespace supercoil::host_sim
