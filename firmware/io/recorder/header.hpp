// The first 512 bytes of a recording.
#pragma once

#include "recorder/recording.hpp"

namespace supercoil::recorder {

struct HeaderError {
  std::string text;
  bool final;  ///< the rows cannot be read either
};

/// Why the file cannot be a recording of this format; empty when it may be one.
std::string not_ours(std::string_view file);

/// start: the first header_bytes of a file that not_ours() lets pass.
tl::expected<Header, HeaderError> decode_header(std::string_view start);

}  // namespace supercoil::recorder
