// Frames as the page receives them.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"

#include "apps/supercoil/bus/recent.hpp"

namespace supercoil::operating {

/// One JSON object: {"newest_s":…,"nodes":{"1":{"Measurement":{"time_s":[…],"position_m":[…],…}}},
/// "bus":{"load":…,…}}. Arrays of a message are of one length; null: not available, or not in this
/// frame. Frames to a node that has sent nothing itself are left out.
std::string to_batch(const std::vector<hal::CanFrame>& frames, const FrameHistory& history);

/// The protocol's units and names of values: {"Status":{"state":{"unit":"","values":{"0":…}}}}.
std::string protocol_json();

}  // namespace supercoil::operating
