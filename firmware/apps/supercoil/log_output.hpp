// Where what `log` reads goes to.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace supercoil::operating {

/// Takes a part of what is written; the error says why it could not be.
using Sink = std::function<tl::expected<void, std::string>(std::string_view)>;
/// Writes it all to the sink, and says how much there was of whatever it counts.
using Produce = std::function<tl::expected<std::size_t, std::string>(const Sink&)>;
/// Into a file, or with an empty path to standard output. Where there was nothing no file is left,
/// and that is said. Returns the program's exit status.
int write_output(const std::string& path, const std::string& nothing, const Produce& produce);

}  // namespace supercoil::operating
