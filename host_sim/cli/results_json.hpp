// What the commands that end in tables print for programs: docs/json.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/diagnostics.hpp"
#include "scenario/builtin.hpp"

namespace supercoil::host_sim {

/// The rows of a file.csv that has no quotes, as objects by its columns: text in those that are
/// named, numbers in all others, null where nothing stands. "yes" and "no" are true and false.
nlohmann::ordered_json rows_json(std::string_view csv,
                                 const std::vector<std::string_view>& text_columns);

/// Each with its name and what it shows.
nlohmann::ordered_json entries_json(const std::vector<BuiltinScenario>& entries);

/// results: after the versions, which every answer begins with.
void print_results(const nlohmann::ordered_json& results);

/// Says what is wrong: with json to programs, as run --json does, and nothing to standard error.
/// Returns the status.
int refuse(bool json, int status, const std::string& message);
/// The same of a wrong input. Returns that status.
int refuse_problems(bool json, const Errors& problems);
/// A problem a line.
int refuse_lines(bool json, const std::string& lines);

}  // namespace supercoil::host_sim
