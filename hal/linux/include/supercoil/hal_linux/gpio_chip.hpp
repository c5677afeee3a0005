// A GPIO chip and its lines, through libgpiod; versions 1 and 2 have a source file each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal/digital_line.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::hal_linux {

/// How a line is used.
enum class Direction { input, output };

/// A line that this process holds exclusively, until this object ends. Its level after that depends
/// on the chip, so set it low before. Move-only. set() and get() are one system call each and
/// allocate nothing.
class HeldLine {
 public:
  struct Handle;
  struct Release {
    void operator()(Handle* handle) const noexcept;
  };
  using Owned = std::unique_ptr<Handle, Release>;

  explicit HeldLine(Owned handle) : handle_(std::move(handle)) {}

  hal::Status set(bool high) noexcept;
  hal::Level get() noexcept;

 private:
  Owned handle_;
};

/// The chip's own resistor at a line.
enum class Bias { unknown, none, pull_up, pull_down };

/// A line as the kernel describes it.
struct LineDescription {
  std::string name;      ///< empty: none
  std::string consumer;  ///< the program that holds it; empty: none
  Bias bias = Bias::unknown;
};

/// An opened chip. Move-only.
class GpioChip {
 public:
  /// path: /dev/gpiochip0
  static Result<GpioChip> open(const std::string& path);

  std::string name() const;   ///< gpiochip0
  std::string label() const;  ///< pinctrl-bcm2711
  unsigned line_count() const;
  LineDescription describe(unsigned offset) const;
  /// An output is low from the first moment. EBUSY when the line is already held. Consumes the
  /// chip, which the line depends on in libgpiod 1.
  Result<HeldLine> request(unsigned offset, Direction direction) &&;

 private:
  struct Handle;
  struct Close {
    void operator()(Handle* handle) const noexcept;
  };
  explicit GpioChip(std::unique_ptr<Handle, Close> handle) : handle_(std::move(handle)) {}

  std::unique_ptr<Handle, Close> handle_;
};

}  // namespace supercoil::hal_linux
