// Checks of a command line that CLI11 does not make.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "text/nearest.hpp"

namespace supercoil {

/// For options that take a number: CLI11's ranges accept NaN.
inline const CLI::Validator is_finite(
    [](const std::string& text) {
      double value = 0.0;
      const bool ok = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
      return ok ? std::string() : text + ": must be a finite number";
    },
    "");

/// After is_finite.
inline const CLI::Validator is_positive(
    [](const std::string& text) {
      double value = 0.0;
      const bool ok = CLI::detail::lexical_cast(text, value) && value > 0.0;
      return ok ? std::string() : text + ": must be more than 0";
    },
    "POSITIVE");

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
