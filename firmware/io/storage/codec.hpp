// A learned set as text, and back.
#pragma once

#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

#include "board/learned.hpp"

namespace supercoil::storage {

/// TOML after a line with format, length and CRC-32. Numbers have the fewest digits that read back
/// as the same double. encode() accepts a set that fails check(); decode() refuses it.
std::string encode(const board::Learned& learned);

/// The set, bit for bit, if the text is complete, has a known format, every key and no other, and
/// the set passes check(). The error continues the file's name: "is cut off: …".
Result<board::Learned> decode(std::string_view text);

}  // namespace supercoil::storage
