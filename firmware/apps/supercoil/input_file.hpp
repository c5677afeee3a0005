// A file that somebody else wrote, whole.
#pragma once

#include <string>

#include <tl/expected.hpp>

namespace supercoil::operating {

/// At most 1 GiB. The error names the file, and says why not.
tl::expected<std::string, std::string> read_whole(const std::string& path);

}  // namespace supercoil::operating
