#include "config/diagnostics.hpp"

namespace supercoil::config {

std::string to_text(const Errors& problems) {
  std::string result;
  for (const Error& problem : problems)
    result += problem.text() + "\n";
  return result;
}

}  // namespace supercoil::config
