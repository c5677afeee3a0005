// The first line of a stored file, which shows whether the rest is whole.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

namespace supercoil::storage {

/// A stored set is about 600 bytes; a larger file than this was not written by this program.
inline constexpr std::size_t max_file_bytes = 65'536;

/// The number in the first line; it grows when the keys or their meaning change. Format 1, of
/// 0.1.0, can be read too.
inline constexpr unsigned file_format = 2;

/// The body after a line that gives format, length and CRC-32:
/// "# supercoil learned, format 2, 512 bytes, CRC-32 0123abcd".
std::string seal(std::string_view body, unsigned format = file_format);

/// The content of a stored file that is whole.
struct Unsealed {
  std::string_view body;
  unsigned format;
};

/// The body of a sealed text, as a view into it. The error says what is wrong: empty, too large,
/// not text, not a stored set, a newer format, cut off, extra bytes at its end, or changed.
Result<Unsealed> unseal(std::string_view text);

}  // namespace supercoil::storage
