// Inputs and outputs of the board: GPIO lines, found by names.
#pragma once

#include <memory>
#include <string>

#include "supercoil/hal/digital_line.hpp"
#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/gpio_chip.hpp"

namespace supercoil::hal_linux {

/// A line's names, which, unlike its numbers, do not change with the kernel.
struct LineName {
  std::string chip;  ///< label, as gpiodetect shows it
  std::string line;  ///< name, as gpioinfo shows it
};

/// Takes the line for this process, as consumer "supercoil". A chip or line that is missing, exists
/// twice or is in use is an error that says what there is instead. dev: where the chips are.
Result<HeldLine> hold_line(const LineName& name, Direction direction,
                           const std::string& dev = "/dev");

/// An undriven line.
struct UndrivenLine {
  hal::Level level;
  Bias bias = Bias::unknown;  ///< the chip's own; a resistor on the board is not visible
};

/// Takes the line as an input for a moment. Errors as hold_line().
Result<UndrivenLine> read_undriven(const LineName& name, const std::string& dev = "/dev");

/// An output. Low when it is opened, and low again before it is released.
class GpioOutput final : public hal::DigitalOutput {
 public:
  static Result<std::unique_ptr<GpioOutput>> open(const LineName& name,
                                                  const std::string& dev = "/dev");
  explicit GpioOutput(HeldLine line) : line_(std::move(line)) {}
  ~GpioOutput() override;

  hal::Status set(bool high) override { return line_.set(high); }

 private:
  HeldLine line_;
};

/// An input. Its pull resistors are left as they are.
class GpioInput final : public hal::DigitalInput {
 public:
  static Result<std::unique_ptr<GpioInput>> open(const LineName& name,
                                                 const std::string& dev = "/dev");
  explicit GpioInput(HeldLine line) : line_(std::move(line)) {}

  hal::Level read() override { return line_.get(); }

 private:
  HeldLine line_;
};

}  // namespace supercoil::hal_linux
