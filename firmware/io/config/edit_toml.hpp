// Changes single values in a board's file and leaves the rest as its author wrote it.
#pragma once

#include <cstddef>
#include <string>

#include "supercoil/hal/error.hpp"

namespace supercoil::config {

/// The file's text with one key of one [[channel]] or [[joint]] set to a literal: in place if the
/// key exists, else in its table, else in the first line of the [[channel]] or [[joint]]. Comments
/// and order stay. text: valid TOML. kind: "channel" or "joint". place: index within its kind, from
/// 0. path: "limits.max_W" or "controller", one table deep. literal: a TOML value on one line. The
/// error says what could not be done.
Result<std::string> with_value(const std::string& text, const std::string& kind, std::size_t place,
                               const std::string& path, const std::string& literal);

}  // namespace supercoil::config
