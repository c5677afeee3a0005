// Knots of a trajectory that a page sends, as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/monitor/manual_control.hpp"

namespace supercoil::operating {

/// The board takes some 10 ms to answer each knot, and other requests wait meanwhile.
inline constexpr std::size_t max_knots_at_once = 16;

struct TrajectoryRequest {
  std::uint8_t node;  ///< 1 to 63
  std::vector<ManualControl::NextKnot> knots;
  bool start;
};

/// {"node":1,"knots":[{"after_s":0.04,"position_m":0.002,"velocity_m_per_s":0.001}],"start":false};
/// knots and start may be absent. The error names the knot, its value and the allowed range.
Result<TrajectoryRequest> parse_trajectory_request(const std::string& text);

/// {"refusal":"none","taken":1,"playback":"loaded","room":62,"buffered_s":0.04}
std::string sent_json(const ManualControl::Sent& sent);

}  // namespace supercoil::operating
