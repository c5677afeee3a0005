#include "config/toml_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace supercoil::config {

namespace {
constexpr std::uintmax_t largest_bytes = 1 << 20;
}

std::string read_text(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    diagnostics.add(0, "", "there is no such file");
    return {};
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    diagnostics.add(0, "", "is not a file");
    return {};
  }
  if (std::filesystem::file_size(path, error) > largest_bytes) {
    diagnostics.add(0, "", "is larger than 1 MiB, which no configuration is");
    return {};
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) {
    diagnostics.add(0, "", "cannot be read: " + std::generic_category().message(errno));
    return {};
  }
  return text.str();
}

toml::table parse(const std::string& text, Diagnostics& diagnostics) {
  try {
    return toml::parse(text, diagnostics.file());
  } catch (const toml::parse_error& error) {
    diagnostics.add(static_cast<int>(error.source().begin.line), "",
                    "is not valid TOML: " + std::string(error.description()));
    return {};
  }
}

}  // namespace supercoil::config
