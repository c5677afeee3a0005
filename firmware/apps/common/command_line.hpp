// Command lines: checks that CLI11 does not make, and what several programs have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/common/docs_options.hpp"
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

inline void add_docs(CLI::App& app, DocsOptions& options) {
  CLI::App* docs = app.add_subcommand(
      "docs", "Serve this documentation to a browser on this machine until Ctrl-C");
  docs->add_option("--port", options.port, "Port of the site; 0 takes a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  docs->add_flag("--open", options.open, "Open it in the browser too, with xdg-open");
  docs->add_option("--folder", options.folder, "Folder of the site that toolchain/docs built")
      ->type_name("DIR")
      ->capture_default_str();
}

/// The first of these arguments that is an option, without "=VALUE"; empty: none is.
inline std::string first_option(const std::vector<std::string>& arguments) {
  const auto found = std::find_if(arguments.begin(), arguments.end(),
                                  [](const std::string& each) { return each.starts_with('-'); });
  return found == arguments.end() ? std::string() : found->substr(0, found->find('='));
}

/// What the command line has that no command expects, where CLI11 would say no more, or only that
/// something else is missing; empty: nothing.
inline std::string unexpected_argument(const CLI::App& app, const CLI::ParseError& error) {
  const bool too_many = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (!too_many && dynamic_cast<const CLI::RequiredError*>(&error) == nullptr) return {};
  const std::vector<std::string> unexpected = app.remaining(true);
  const auto without_dashes = [](const std::string& name) {
    return name.substr(std::min(name.find_first_not_of('-'), name.size()));
  };
  if (const std::string option = first_option(unexpected); !option.empty()) {
    const auto commands = app.get_subcommands();
    const CLI::App& command = commands.empty() ? app : *commands.front();
    std::vector<std::string> names;
    for (const CLI::Option* const each : command.get_options()) {
      if (each->nonpositional()) names.push_back(without_dashes(each->get_name()));
    }
    const std::string nearest = nearest_name(without_dashes(option), names).name;
    return option + " is not an option; " +
           (nearest.empty() ? "--help lists those that there are"
                            : "did you mean --" + nearest + "?");
  }
  if (!too_many || unexpected.empty()) return {};
  return "'" + unexpected.front() +
         "' is one argument too many; --help lists those that are expected";
}

}  // namespace supercoil
