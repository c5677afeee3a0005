#include <cstdio>

#include "cli/commands.hpp"

namespace supercoil::host_sim {

int fail(int status, const std::string& message) {
  std::fprintf(stderr, "supercoil-sim: %s\n", message.c_str());
  return status;
}

}  // namespace supercoil::host_sim
