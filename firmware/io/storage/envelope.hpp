// The first line of a stored file, which shows whether the rest is whole.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

namespace supercoil::storage {

/// A stored set is about 600 bytes; what is larger was not written by this program.
inline constexpr std::size_t max_file_bytes = 65'536;

/// The number that the first line gives; it grows when the keys or their meaning change. Format 1,
/// of 0.1.0, is read too.
inline constexpr unsigned file_format = 2;

/// The body behind a line that gives format, length and CRC-32:
/// "# supercoil learned, format 2, 512 bytes, CRC-32 0123abcd".
std::string seal(std::string_view body, unsigned format = file_format);

struct Unsealed {
  std::string_view body;
  unsigned format;
};

/// The body of a sealed text, a view into it. The error says in which way it is not whole: empty,
/// too large, not text, not ours, of a newer format, cut off, with more at its end, or changed.
Result<Unsealed> unseal(std::string_view text);

}  // namespace supercoil::storage
