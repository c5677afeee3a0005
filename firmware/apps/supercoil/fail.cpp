// How the commands of supercoil report errors.
#include <cstdio>

#include <nlohmann/json.hpp>

#include "apps/supercoil/commands.hpp"

namespace supercoil::operating {

int fail(int status, const std::string& message) {
  std::fprintf(stderr, "supercoil: %s\n", message.c_str());
  return status;
}

void print_error(const std::string& message) {
  const nlohmann::ordered_json error{{"error", message}};
  std::printf("%s\n", error.dump().c_str());
}

int refuse(bool json, int status, const std::string& message) {
  if (json) print_error(message);
  return fail(status, message);
}

}  // namespace supercoil::operating
