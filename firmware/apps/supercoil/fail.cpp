// How the commands of supercoil report errors.
#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/supercoil/commands.hpp"

namespace supercoil::operating {

int fail(int status, const std::string& message) {
  std::fprintf(stderr, "supercoil: %s\n", message.c_str());
  return status;
}

void tell_error(const std::string& message) {
  const nlohmann::ordered_json told{{"error", message}};
  std::printf("%s\n", told.dump().c_str());
}

int refuse(bool json, int status, const std::string& message) {
  if (json) tell_error(message);
  return fail(status, message);
}

}  // namespace supercoil::operating
