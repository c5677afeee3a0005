// The known name that an unknown one was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace supercoil {

/// A suggestion for a name that is not known.
struct Nearest {
  std::string name;         ///< empty when nothing is near
  bool lacks_unit = false;  ///< what was written is the name without its unit
};

/// The shortest known name that starts with what was written and "_"; else the one with the fewest
/// edits, up to a third of its length, where two swapped letters are one edit; else the one with
/// the most similar beginning, up to a quarter of it: "bandwith" is bandwidth_rad_per_s.
Nearest nearest_name(std::string_view written, const std::vector<std::string>& known);

/// Text after "…; ": "did you mean NAME?", or all names if none is near: "OTHERWISE: a, b".
std::string suggestion_or_all(std::string_view written, const std::vector<std::string>& known,
                              std::string_view otherwise);

/// "a, b, c"
std::string joined(const std::vector<std::string>& names);

}  // namespace supercoil
