#include "apps/supercoil/setup/options.hpp"

namespace supercoil::operating {

std::string SetupOptions::board_words() const {
  return can.empty() ? socket_words(socket) : " --can " + can;
}

std::string SetupOptions::command(std::string_view step) const {
  std::string line = "supercoil setup " + std::string(step);
  if (config != default_config) line += " --config " + config;
  if (channel != 1) line += " --channel " + std::to_string(channel);
  return line + board_words();
}

}  // namespace supercoil::operating
