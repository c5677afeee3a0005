// Whether a CAN interface is ready to be used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/machine.hpp"

namespace supercoil::hal_linux {

/// Link, bit rate, and length of the queue of frames to send. interface: e.g. can0.
void check_can_interface(const Machine& machine, const std::string& interface,
                         const hal::FindingSink& sink);

/// In bit/s, as the kernel tells it by rtnetlink; nothing of an interface that has none (vcan).
std::optional<std::uint32_t> can_bit_rate(const std::string& interface);
/// The same, of the kernel's answer.
std::optional<std::uint32_t> bit_rate_in(const std::vector<std::byte>& answer);

}  // namespace supercoil::hal_linux
