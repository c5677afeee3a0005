// Reads a TOML file from disk, and says in words why that fails.
#pragma once

#include <cstdint>
#include <string>

#include <toml++/toml.h>

#include "config/diagnostics.hpp"

namespace supercoil::config {

/// The file's text; notes why it cannot be read (absent, a folder, no permission, over 1 MiB).
std::string read_text(const std::string& path, Diagnostics& diagnostics);

/// The text as a table; notes a syntax error with its line.
toml::table parse(const std::string& text, Diagnostics& diagnostics);

/// Of a document's content: comments, spaces and the order of keys do not count.
std::uint32_t crc32_of(const toml::table& document);

}  // namespace supercoil::config
