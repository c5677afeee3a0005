#include "injected_faults.hpp"

#include <array>
#include <cerrno>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace supercoil::rig {

namespace {

using host_sim::ConverterFaults;

bool on_or_off(const std::string& word, bool& value) {
  value = word == "on";
  return value || word == "off";
}

bool set_converter(const std::string& word, host_sim::SimulatedConverter& converter) {
  ConverterFaults faults;
  faults.silent = word == "silent";
  faults.frozen = word == "frozen";
  faults.loose = word == "loose";
  if (word != "well" && faults == ConverterFaults{}) return false;
  converter.set(faults);
  return true;
}

bool set_channel(const std::string& what, const std::string& word,
                 host_sim::MuscleChannel& channel) {
  if (what == "position") return set_converter(word, channel.position);
  if (what == "current") return set_converter(word, channel.current);
  if (what == "short_Ohm")
    return static_cast<bool>(std::istringstream(word) >> channel.faults.short_Ohm);
  if (what == "wire_open") return on_or_off(word, channel.faults.wire_open);
  if (what == "switch_stuck_on") return on_or_off(word, channel.faults.switch_stuck_on);
  if (what == "enable_stuck_on") return on_or_off(word, channel.faults.enable_stuck_on);
  if (what == "slack") return on_or_off(word, channel.faults.slack);
  return false;
}

}  // namespace

std::string obey(const std::string& order, host_sim::SimulatedBoard& board, std::size_t channels) {
  std::istringstream words(order);
  std::string subject, what, word;
  std::size_t number = 0;
  bool understood = false;
  words >> subject;
  if (subject == "channel") {
    words >> number >> what >> word;
    if (!words || number >= channels) return "expects: channel NUMBER WHAT VALUE";
    understood = set_channel(what, word, board.channel(number));
  } else if (words >> word; subject == "supply") {
    understood = set_converter(word, board.supply);
  } else if (subject == "supply_V") {
    double supply_V = 0.0;
    understood = static_cast<bool>(std::istringstream(word) >> supply_V);
    if (understood) board.set_supply_V(supply_V);
  } else if (subject == "pump_stuck") {
    understood = on_or_off(word, board.pump.stuck_closed);
  }
  return understood ? "" : "is not known: see plant/injected_faults.hpp";
}

// For reading and writing, so that the FIFO does not end when a writer closes it.
Orders::Orders(const std::string& path)
    : file_(open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), path);
}

Orders::~Orders() {
  close(file_);
}

std::string Orders::next() {
  std::array<char, 256> block{};
  const ssize_t count = read(file_, block.data(), block.size());
  if (count > 0) received_.append(block.data(), static_cast<std::size_t>(count));
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos) return {};
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

}  // namespace supercoil::rig
