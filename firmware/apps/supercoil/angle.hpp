// Angles of a joint in commands of a person: "20deg".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "apps/supercoil/board_link.hpp"

namespace supercoil::operating {

/// The number of "20deg"; empty: it is no angle.
std::optional<double> degrees_of(std::string_view text);

/// The arc at the joint's lever, as the board tells the lever. channel: as in a line. The error:
/// the board does not answer, or the channel is in no joint.
tl::expected<double, std::string> metres_per_degree(BoardLink& board, const std::string& channel);

}  // namespace supercoil::operating
