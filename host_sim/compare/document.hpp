// Controllers and disturbances as they were asked for: by name, or in a file.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

namespace supercoil::host_sim::compare {

struct Document {
  std::string name;      ///< in tables
  std::string text;      ///< TOML
  double later_s = 0.0;  ///< of a disturbance: so much later
  bool steps = false;    ///< of a disturbance: asked for steps instead of its sine
};

/// Each by its name, or all that is wrong with them, a line each.
using Documents = supercoil::Result<std::vector<Document>>;

/// Built-in names, or files: what has a dot or a slash.
Documents find_controllers(const std::vector<std::string>& names);
/// Likewise; :steps and then +SECONDS may come after each.
Documents find_disturbances(const std::vector<std::string>& names);

}  // namespace supercoil::host_sim::compare
