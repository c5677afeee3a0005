// The first 512 bytes of a recording.
#pragma once

#include "supercoil/hal/error.hpp"

#include "recorder/recording.hpp"

namespace supercoil::recorder {

/// The first bytes of every format.
inline constexpr std::string_view magic = "supercoil flight recording, format ";

/// Why the file cannot be a recording of this format; empty when it may be one.
std::string format_problem(std::string_view file);

/// start: the first header_bytes of a file that format_problem() accepts. Error not_supported: the
/// rows cannot be read either.
Result<Header> decode_header(std::string_view start);

}  // namespace supercoil::recorder
