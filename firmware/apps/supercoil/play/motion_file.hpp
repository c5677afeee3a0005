// Reads the motions that supercoil play sends: a CSV file of knots.
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

/// Reads as CsvLines does. Columns: time_s, position_m and optionally velocity_m_per_s; for several
/// nodes 2:position_m and so on. Missing velocities are those of the parabola through three rows,
/// and 0 at both ends. node: owns the columns without a number. The error names file, line and
/// value.
Result<std::vector<Motion>> read_motions(const std::string& path, std::uint8_t node);

}  // namespace supercoil::operating
