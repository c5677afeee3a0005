// Controllers and disturbances as they were asked for: by name, or in a file.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

namespace supercoil::host_sim::compare {

struct Document {
  std::string name;      ///< in tables
  std::string text;      ///< TOML
  double later_s = 0.0;  ///< of a disturbance: delay of its events and its end
  bool steps = false;    ///< of a disturbance: asked for steps instead of its sine
};

/// The documents that were named, or all that is wrong with them, one problem per line.
using Documents = supercoil::Result<std::vector<Document>>;

/// Built-in names, or files, which have a dot or a slash.
Documents find_controllers(const std::vector<std::string>& names);
/// Likewise; each may be followed by :steps and then +SECONDS.
Documents find_disturbances(const std::vector<std::string>& names);

}  // namespace supercoil::host_sim::compare
