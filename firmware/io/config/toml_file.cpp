#include "config/toml_file.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "storage/crc32.hpp"

namespace supercoil::config {

namespace {

constexpr std::uintmax_t max_bytes = 1 << 20;
/// A key of tens of thousands of parts would overflow the parser's stack.
constexpr std::size_t max_line = 4096;

/// The number of the first line that is too long, or 0.
int overlong_line(const std::string& text) {
  int line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (end - start > max_line) return line;
    start = end + 1;
  }
  return 0;
}

}  // namespace

std::string read_text(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  const bool exists = std::filesystem::exists(path, error);
  if (error) {
    diagnostics.add(0, "", "cannot be read: " + error.message());
    return {};
  }
  if (!exists) {
    diagnostics.add(0, "", "there is no such file");
    return {};
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    diagnostics.add(0, "", "is not a file");
    return {};
  }
  if (std::filesystem::file_size(path, error) > max_bytes) {
    diagnostics.add(0, "", "is larger than the limit of 1 MiB");
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
  if (const int line = overlong_line(text)) {
    diagnostics.add(line, "", "is longer than " + std::to_string(max_line) + " characters");
    return {};
  }
  try {
    return toml::parse(text, diagnostics.file());
  } catch (const toml::parse_error& error) {
    diagnostics.add(static_cast<int>(error.source().begin.line), "",
                    "is not valid TOML: " + std::string(error.description()));
    return {};
  }
}

std::uint32_t crc32_of(const toml::table& document) {
  std::ostringstream text;
  text << document;
  return storage::crc32(text.str());
}

}  // namespace supercoil::config
