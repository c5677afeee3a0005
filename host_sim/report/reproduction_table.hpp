// The reproduction as CSV, as a table on the terminal, and as one self-contained page.
#pragma once

#include <string>
#include <vector>

#include "paper/reproduction.hpp"

namespace supercoil::host_sim {

/// id,case,quantity,unit,paper,measured,remark; fields with commas or quotes are quoted (RFC 4180).
std::string to_csv(const std::vector<paper::Part>& parts);

/// Columns aligned for people.
std::string to_terminal(const std::vector<paper::Part>& parts);

/// svg_of: the SVG text of each figure, in the order of the parts' figures; empty leaves it out.
std::string to_html(const std::vector<paper::Part>& parts, const std::vector<std::string>& svg_of);

}  // namespace supercoil::host_sim
