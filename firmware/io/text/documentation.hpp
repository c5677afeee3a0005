// How messages refer to a page of the documentation, which is also there where only a package is.
#pragma once

#include <string>
#include <string_view>

namespace supercoil {

/// The command that serves the pages. supercoil-sim, whose package does not need supercoil, sets
/// its own when it starts.
inline std::string_view documentation_command = "supercoil docs";

/// "faults/heater_open in `supercoil docs`". page: the file's path below docs/, without its .md.
inline std::string documentation_page(std::string_view page) {
  return std::string(page) + " in `" + std::string(documentation_command) + "`";
}

}  // namespace supercoil
