// One value of a driver, as sysfs shows it: a small text file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal/status.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::hal_linux {

/// A whole number as an attribute gives it, or why there is none.
struct Number {
  std::int64_t value = 0;
  hal::Status status = hal::Status::not_ready;
};

/// A decimal number with an optional minus, and at most a newline after it. Anything else, and a
/// number that does not fit into 64 bits, is an io_error.
Number parse_number(std::string_view text) noexcept;

/// An attribute held open, so that a tick neither looks up a path nor allocates. Move-only.
class Attribute {
 public:
  enum class Use { read, write, both };

  /// Anything but a regular file is refused: a pipe would block the reader.
  static Result<Attribute> open(const std::string& path, Use use);

  /// For ticks: never allocates; how long a read or write takes depends on the driver.
  Number number() const noexcept;
  hal::Status write(std::int64_t value) const noexcept;
  hal::Status write(std::string_view text) const noexcept;

  /// For set-up: the text without its newline. A text longer than a page, or with an unprintable
  /// byte, is an error.
  Result<std::string> text() const;
  /// For set-up: as write() and number(), and the error names the path and what was written.
  Result<void> set(std::string_view text) const;
  Result<std::int64_t> integer() const;

  const std::string& path() const { return path_; }

 private:
  Attribute(Descriptor file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}

  Descriptor file_;
  std::string path_;
};

/// An attribute that is read once.
Result<std::string> read_text(const std::string& path);
Result<std::int64_t> read_integer(const std::string& path);
/// An attribute that is written once.
Result<void> write_text(const std::string& path, std::string_view text);

}  // namespace supercoil::hal_linux
