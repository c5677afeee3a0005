// The DBC of a bus with certain nodes, from that of node 1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace supercoil::operating {

/// firmware/io/can/supercoil.dbc, as this program was built with it.
extern const std::string_view node_1_dbc;

/// Every message once for each node, its identifier higher by what the node is above 1, and
/// "_NODE" behind its name and its sender's. nodes: distinct, 1 to 63.
std::string bus_dbc(std::string_view dbc, const std::vector<int>& nodes);

}  // namespace supercoil::operating
