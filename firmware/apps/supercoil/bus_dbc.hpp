// The DBC of a bus with given nodes, derived from node 1's.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace supercoil::operating {

/// firmware/io/can/supercoil.dbc at the time of the build.
extern const std::string_view node_1_dbc;

/// Repeats every message for each node. The identifier grows by the node's distance from 1, and
/// "_NODE" is appended to the message's name and its sender's. nodes: distinct, 1 to 63.
std::string bus_dbc(std::string_view dbc, const std::vector<int>& nodes);

}  // namespace supercoil::operating
