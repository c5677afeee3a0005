// A learned set as text, and back.
#pragma once

#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

#include "board/learned.hpp"

namespace supercoil::storage {

/// TOML behind a line with format, length and CRC-32. Numbers have the fewest digits that give the
/// same double back. A set that fails check() is written as well, and decode() refuses it.
std::string encode(const board::Learned& learned);

/// The set, bit for bit, when the text is whole, of a known format, has every key and no other, and
/// the set passes check(). The error goes on from the file's name: "is cut off: …".
Result<board::Learned> decode(std::string_view text);

}  // namespace supercoil::storage
