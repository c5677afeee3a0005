// Commands of a program that has several.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "text/nearest.hpp"

namespace supercoil {

/// What is wrong with the first word; empty if it is a command, an option or absent. CLI11 would
/// only say that a command is missing.
inline std::string wrong_command(const CLI::App& app, int count, char** arguments) {
  const std::string written = count > 1 ? arguments[1] : "";
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({}))
    names.push_back(command->get_name());
  if (written.empty() || written.front() == '-' ||
      std::find(names.begin(), names.end(), written) != names.end())
    return {};
  return "'" + written + "' is not a command; " +
         suggestion_or_all(written, names, "the commands are");
}

}  // namespace supercoil
