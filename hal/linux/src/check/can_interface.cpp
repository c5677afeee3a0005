#include <charconv>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/checks.hpp"
#include "supercoil/hal_linux/device_folder.hpp"

namespace supercoil::hal_linux {

namespace {

using hal::Severity;

/// ARPHRD_CAN.
constexpr std::int64_t can_type = 280;
/// IFF_UP.
constexpr unsigned up_flag = 1;
/// All frames that a board of 16 channels sends within some 10 ms.
constexpr std::int64_t min_queue = 100;

/// sysfs shows flags as 0x40080.
bool is_up(const std::string& folder) {
  const std::string text = read_text(folder + "/flags").value_or("");
  if (!text.starts_with("0x")) return false;
  unsigned flags = 0;
  std::from_chars(text.data() + 2, text.data() + text.size(), flags, 16);
  return (flags & up_flag) != 0;
}

}  // namespace

void check_can_interface(const Machine& machine, const std::string& interface,
                         const hal::FindingSink& sink) {
  const std::string what = "CAN " + interface;
  const std::string root = machine.sys + "/class/net";
  const std::string folder = root + "/" + interface;
  const std::string bring_up =
      "ip link set " + interface + " up type can bitrate 500000 restart-ms 100";
  const auto type = read_integer(folder + "/type");
  if (!type) {
    const auto all = names_in(root).value_or(std::vector<std::string>{});
    sink({what, Severity::problem,
          "no interface '" + interface + "' in " + root + ": there " +
              (all.empty() ? "is none" : "are " + listed(all)),
          "load its driver, or name the right one"});
    return;
  }
  if (*type != can_type) {
    sink({what, Severity::problem,
          folder + "/type is " + std::to_string(*type) + ": not CAN (" + std::to_string(can_type) +
              ")",
          "name the right interface"});
    return;
  }
  if (!is_up(folder)) return sink({what, Severity::problem, "down", bring_up});
  // Not operstate, which follows a second later.
  if (read_integer(folder + "/carrier").value_or(0) != 1) {
    return sink({what, Severity::problem, "set up, but off the bus (no carrier)",
                 "check the wires, terminations and bit rate; then " + bring_up});
  }
  const auto rate = can_bit_rate(interface);
  const auto queue = read_integer(folder + "/tx_queue_len");
  const std::string found = "up, " + (rate ? std::to_string(*rate) + " bit/s" : "no bit rate") +
                            ", queue of " +
                            (queue ? std::to_string(*queue) : "an unknown number of") + " frames";
  if (queue && *queue >= min_queue) {
    sink({what, Severity::ok, found, ""});
  } else {
    sink({what, Severity::warning, found,
          "ip link set " + interface + " txqueuelen 1000: a short queue refuses frames (ENOBUFS)"});
  }
}

}  // namespace supercoil::hal_linux
