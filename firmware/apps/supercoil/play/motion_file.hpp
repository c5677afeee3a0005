// The motions that supercoil play sends: a CSV file of knots.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "supercoil/control/tracking/trajectory.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::operating {

/// Knots of one node; the first is at time 0 and at rest.
struct Motion {
  std::uint8_t node = 1;
  std::vector<control::Knot> knots;
};

/// As CsvLines reads it. Columns: time_s, position_m and, if wanted, velocity_m_per_s; for several
/// nodes 2:position_m and so on. Velocities that the file lacks are those of the parabola through
/// three rows, and 0 at both ends. node: whose the columns without a number are. The error names
/// file, line and value.
Result<std::vector<Motion>> read_motions(const std::string& path, std::uint8_t node);

}  // namespace supercoil::operating
