#include "apps/supercoil/doctor/check_devices.hpp"

#include <set>

#include "linux_board/parts.hpp"

namespace supercoil::doctor {

namespace {

/// Sums the times of each bus's devices. A bus with a missing device gets no sum: a partial one
/// would look too good.
BusTimes bus_times(const std::vector<BusShare>& shares) {
  BusTimes times;
  std::set<std::string> incomplete;
  for (const BusShare& share : shares) {
    times[share.bus] += share.time.value_or(hal::Duration{});
    if (!share.time) incomplete.insert(share.bus);
  }
  for (const std::string& bus : incomplete)
    times.erase(bus);
  return times;
}

}  // namespace

BusTimes check_devices(const config::BoardConfig& config, const hal_linux::Machine& machine,
                       int priority, const hal::FindingSink& sink) {
  linux_board::Parts parts = linux_board::open_parts(config.wiring, machine);
  check_lines(config.wiring, machine, parts, priority, sink);
  std::vector<BusShare> shares;
  check_pwms(config.wiring, parts, priority, sink, shares);
  check_converters(config, machine, parts, priority, sink, shares);
  return bus_times(shares);
}

}  // namespace supercoil::doctor
