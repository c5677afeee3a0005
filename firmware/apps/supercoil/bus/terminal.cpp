#include "apps/supercoil/bus/terminal.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <thread>

#include <unistd.h>

#include "apps/common/exit_status.hpp"
#include "can/codec.hpp"
#include "modes/result.hpp"
#include "telemetry/opcodes.hpp"
#include "text/margin_unit.hpp"
#include "text/result_words.hpp"

namespace supercoil::operating {

namespace {

using can::Decoded;

/// The newest message of each kind of one node.
using Newest = std::map<std::string_view, Decoded>;

double value(const Newest& node, std::string_view message, std::string_view signal) {
  const auto found = node.find(message);
  if (found == node.end()) return NAN;
  return found->second.values.at(can::signal_index(*found->second.message, signal));
}

std::string named(const Newest& node, std::string_view message, std::string_view signal) {
  const auto found = node.find(message);
  if (found == node.end()) return "-";
  const auto& known = found->second.message->signals;
  const std::size_t i = can::signal_index(*found->second.message, signal);
  return std::string(can::value_name(known[i], found->second.values.at(i)));
}

/// "position 12.345 mm"; what is not available is "-".
std::string shown(const char* what, double quantity, int digits, const char* unit) {
  std::array<char, 80> text{};
  if (std::isnan(quantity)) {
    std::snprintf(text.data(), text.size(), "  %-12s %10s %s", what, "-", unit);
  } else {
    std::snprintf(text.data(), text.size(), "  %-12s %10.*f %s", what, digits, quantity, unit);
  }
  return text.data();
}

/// Off is not cold: tells how hot the muscle may be, by its upper bound.
std::string off_text(const Newest& node) {
  const double hottest_C = value(node, "Temperature", "hottest_C");
  if (std::isnan(hottest_C)) return "off; temperature not known";
  // From here on, contact for hours burns skin (docs/safety.md).
  constexpr double hot_C = 43.0;
  return (hottest_C < hot_C ? "off; at most " : "off; may still be at ") +
         std::to_string(std::lround(std::ceil(hottest_C))) + " C";
}

/// The margin of the detector that led to the fault, in its own unit (docs/faults).
std::string margin_text(const Newest& node) {
  const double measured = value(node, "FirstCause", "measured");
  const double limit = value(node, "FirstCause", "limit");
  if (std::isnan(limit)) return "";
  std::array<char, 80> text{};
  const auto fault = static_cast<Fault>(value(node, "Status", "fault"));
  std::snprintf(text.data(), text.size(), " (measured %.3g, limit %.3g%s)", measured, limit,
                margin_unit_after(fault).c_str());
  return text.data();
}

/// By node number.
std::map<int, Newest> newest_of(const FrameHistory& frame_history) {
  std::map<int, Newest> nodes;
  // At its default rate every message is sent within this time; at a lower one it may be missing.
  for (const hal::CanFrame& frame :
       frame_history.between(-std::chrono::seconds(3), hal::Time::max())) {
    const auto decoded = can::decode(frame);
    if (!decoded || decoded->message->to_node) continue;
    nodes[decoded->node].insert_or_assign(decoded->message->name, *decoded);
  }
  return nodes;
}

/// "  program 0.2.0 (2780ebf)"; empty: the board does not report it.
std::string program_text(const Newest& node) {
  const auto part = [&](const char* signal) {
    return static_cast<unsigned>(value(node, "Boot", signal));
  };
  if (!node.contains("Boot")) return "";
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "  program %u.%u.%u", part("version_major"),
                part("version_minor"), part("version_patch"));
  std::string version = text.data();
  if (const unsigned commit = part("commit"); commit != 0) {
    std::snprintf(text.data(), text.size(), " (%07x)", commit);
    version += text.data();
  }
  return version + '\n';
}

std::string node_text(int number, const Newest& node, const std::string& kind) {
  const std::string fault = named(node, "Status", "fault");
  const std::string state = named(node, "Status", "state");
  std::string text =
      "node " + std::to_string(number) + ": " + state + ", " + named(node, "Status", "mode");
  const double controller = value(node, "Status", "controller");
  if (!kind.empty() && std::isfinite(controller))
    text += ", " + kind + " (controller " + std::to_string(std::lround(controller)) + ")";
  if (state == "disarmed" || state == "armed" || state == "fault") text += ", " + off_text(node);
  if (fault != "none" && fault != "-") text += ", FAULT " + fault + margin_text(node);
  const std::string limit = named(node, "Power", "limited_by");
  if (limit != "nothing" && limit != "-") text += ", limited by " + limit;
  const double progress = value(node, "Status", "progress");
  const std::string mode = named(node, "Status", "mode");
  if ((mode == "identify" || mode == "calibrate") && std::isfinite(progress))
    text += ", " + std::to_string(std::lround(100.0 * progress)) + " %";
  const std::string result = named(node, "Status", "result");
  const double bits = value(node, "Estimate", "identify_notes");
  const std::string notes =
      bits > 0.0 ? describe_notes(static_cast<std::uint8_t>(bits), ",") : std::string();
  if (result != "none" && result != "running" && result != "-")
    text += ", last identification or calibration: " + result_text(result, notes);
  text += '\n';
  if (value(node, "Status", "friction") == 1.0)
    text += "  friction takes more than half of a small motion, so less power may be allowed\n";
  const double version = value(node, "Status", "protocol_version");
  if (std::isfinite(version) && version != telemetry::protocol_version) {
    text += "  it speaks version " + std::to_string(std::lround(version)) +
            " of the protocol, this program " + std::to_string(telemetry::protocol_version) +
            ": numbers may be wrong; use the matching version of supercoil\n";
  }
  text += program_text(node);
  if (value(node, "Status", "proof_off") == 1.0) {
    text +=
        "  no proof of response (proof_of_response is false, or this muscle is one of a joint's "
        "two or follows in a bundle): a muscle detached from its sensor may overheat undetected\n";
  }
  if (value(node, "Status", "oscillated") == 1.0)
    text += "  the loop oscillated by itself: its feedback is slower now\n";
  if (value(node, "Status", "slack") == 1.0)
    text += "  according to its model this muscle is slack at the present joint angle\n";
  const double angle_deg = value(node, "Joint", "angle_deg");
  if (node.contains("Joint")) text += shown("angle", angle_deg, 3, "deg") + '\n';
  text += shown("position", 1e3 * value(node, "Measurement", "position_m"), 3, "mm") +
          shown("reference", 1e3 * value(node, "Tracking", "reference_m"), 3, "mm") +
          shown("error", 1e6 * value(node, "Tracking", "error_m"), 0, "um") + '\n';
  text += shown("power", value(node, "Power", "applied_W"), 3, "W ") +
          shown("demanded", value(node, "Power", "demanded_W"), 3, "W ") +
          shown("resistance", value(node, "Measurement", "resistance_Ohm"), 3, "Ohm") + '\n';
  text += shown("coldest", value(node, "Temperature", "coldest_C"), 1, "C ") +
          shown("hottest", value(node, "Temperature", "hottest_C"), 1, "C ") +
          shown("supply", value(node, "Heater", "supply_V"), 2, "V") + '\n';
  return text;
}

/// How long a bus has been silent.
class Silence {
 public:
  /// Empty while frames arrive, and before the first one.
  std::string text(const FrameHistory& frame_history) {
    const auto now = std::chrono::steady_clock::now();
    if (const std::uint64_t end = frame_history.end(); end != end_) {
      end_ = end;
      newest_at_ = now;
    }
    const auto silent = std::chrono::duration_cast<std::chrono::seconds>(now - newest_at_);
    if (end_ == 0 || silent < shown_from) return "";
    return "SILENT: no frames for " + std::to_string(silent.count()) + " s; older values follow\n";
  }

 private:
  static constexpr std::chrono::seconds shown_from{2};

  std::uint64_t end_ = 0;
  std::chrono::steady_clock::time_point newest_at_ = std::chrono::steady_clock::now();
};

}  // namespace

std::map<int, int> active_controllers(const FrameHistory& frame_history) {
  std::map<int, int> places;
  for (const auto& [number, node] : newest_of(frame_history)) {
    const double place = value(node, "Status", "controller");
    if (std::isfinite(place)) places[number] = static_cast<int>(place);
  }
  return places;
}

std::string state_text(const FrameHistory& frame_history,
                       const std::map<int, std::string>& controller_kinds) {
  std::map<int, Newest> nodes = newest_of(frame_history);
  const auto frames = frame_history.between(-std::chrono::seconds(3), hal::Time::max());
  const hal::Time newest = frames.empty() ? hal::Time{} : frames.back().received;
  for (auto& [number, node] : nodes) {
    const auto cause = frame_history.first_cause(static_cast<std::uint8_t>(number));
    const auto decoded = cause ? can::decode(*cause) : std::nullopt;
    if (decoded) node.insert_or_assign(decoded->message->name, *decoded);
  }
  const BusFigures bus = frame_history.figures();
  std::array<char, 120> head{};
  std::snprintf(head.data(), head.size(), "at %.3f s: %.0f frames/s, bus %.1f %% busy%s%s\n",
                hal::seconds(newest), bus.frames_per_s, 100.0 * bus.load,
                frame_history.lost().empty() ? "" : "; LOST: ", frame_history.lost().c_str());
  std::string text = head.data();
  if (nodes.empty()) text += "no supercoil node is heard\n";
  for (const auto& [number, node] : nodes) {
    text += node_text(number, node,
                      controller_kinds.contains(number) ? controller_kinds.at(number) : "");
  }
  return text;
}

int show_on_terminal(const FrameHistory& frame_history, bool log,
                     const std::function<bool()>& ended) {
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  const auto every = std::chrono::milliseconds(terminal ? 200 : 1000);
  Silence silence;
  do {
    if (!log) std::this_thread::sleep_for(every);
    // Cursor home, and clear the screen below.
    const std::string text = (terminal && !log ? "\x1b[H\x1b[J" : "") +
                             (log ? "" : silence.text(frame_history)) + state_text(frame_history);
    if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0) return exit_failed;
  } while (!log && !ended());
  return exit_done;
}

}  // namespace supercoil::operating
