// A TOML file from disk, with every way in which that can fail said in words.
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

/// Of what a document says: without comments, spaces and the order of its keys.
std::uint32_t crc32_of(const toml::table& document);

}  // namespace supercoil::config
