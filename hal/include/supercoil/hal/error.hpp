// Why something could not be done: one type for everything that may fail outside a tick.
#pragma once

#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace supercoil {

/// What went wrong, and where. Never made in a tick: it allocates.
struct Error {
  std::string file{};       ///< empty: the message says where
  int line = 0;             ///< 0: the file as a whole
  std::string key{};        ///< the whole path, e.g. plant.moving_mass_kg; empty: none
  std::string message{};    ///< what was looked for, and what was found instead
  std::string value{};      ///< of the key, as written; empty where it has none
  bool of_default = false;  ///< the key is absent, and its default is wrong here
  /// For callers to decide by, instead of the words: errno's value, or its equivalent without a
  /// failed call (timed_out: a board did not answer). 0: there is nothing to decide.
  std::errc code{};

  /// "file:line: key = value: message"
  std::string text() const {
    std::string where = file;
    if (line > 0) where += ":" + std::to_string(line);
    if (!key.empty()) where += (where.empty() ? "" : ": ") + key;
    if (!value.empty()) where += " = " + value;
    if (of_default) where += " (its default)";
    return where.empty() ? message : where + ": " + message;
  }
};

/// Everything that is wrong with an input, so that all of it can be corrected at once.
using Errors = std::vector<Error>;

/// A value, or why there is none.
template <class Value>
using Result = tl::expected<Value, Error>;

/// An error without a location.
inline tl::unexpected<Error> failure(std::string message, std::errc code = {}) {
  return tl::unexpected<Error>(Error{.message = std::move(message), .code = code});
}

/// The same for a failed call, from its errno: "message: No such file or directory".
inline tl::unexpected<Error> failed_call(const std::string& message, int error) {
  return failure(message + ": " + std::generic_category().message(error), std::errc(error));
}

}  // namespace supercoil
