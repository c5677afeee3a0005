// libgpiod 1: Debian 12. A line is a part of its chip and is released with it.
#include <cerrno>

#include <gpiod.h>

#include "supercoil/hal_linux/gpio_chip.hpp"
#include "supercoil/hal_linux/status_of.hpp"

namespace supercoil::hal_linux {

namespace {

std::string text_or_empty(const char* text) {
  return text == nullptr ? std::string{} : std::string{text};
}

Bias bias_of(gpiod_line* line) {
  switch (gpiod_line_bias(line)) {
    case GPIOD_LINE_BIAS_DISABLE:
      return Bias::none;
    case GPIOD_LINE_BIAS_PULL_UP:
      return Bias::pull_up;
    case GPIOD_LINE_BIAS_PULL_DOWN:
      return Bias::pull_down;
    default:
      return Bias::unknown;
  }
}

}  // namespace

struct GpioChip::Handle {
  gpiod_chip* chip;
};

struct HeldLine::Handle {
  gpiod_chip* chip;
  gpiod_line* line;
};

void GpioChip::Close::operator()(Handle* handle) const noexcept {
  if (handle->chip != nullptr) gpiod_chip_close(handle->chip);
  delete handle;
}

void HeldLine::Release::operator()(Handle* handle) const noexcept {
  gpiod_line_release(handle->line);
  gpiod_chip_close(handle->chip);
  delete handle;
}

Result<GpioChip> GpioChip::open(const std::string& path) {
  gpiod_chip* const chip = gpiod_chip_open(path.c_str());
  if (chip == nullptr) return failed_call("cannot open " + path, errno);
  return GpioChip(std::unique_ptr<Handle, Close>(new Handle{chip}));
}

std::string GpioChip::name() const {
  return gpiod_chip_name(handle_->chip);
}

std::string GpioChip::label() const {
  return gpiod_chip_label(handle_->chip);
}

unsigned GpioChip::line_count() const {
  return gpiod_chip_num_lines(handle_->chip);
}

LineDescription GpioChip::describe(unsigned offset) const {
  gpiod_line* const line = gpiod_chip_get_line(handle_->chip, offset);
  if (line == nullptr) return {};
  return {text_or_empty(gpiod_line_name(line)), text_or_empty(gpiod_line_consumer(line)),
          bias_of(line)};
}

Result<HeldLine> GpioChip::request(unsigned offset, Direction direction) && {
  const std::string what = "cannot request line " + std::to_string(offset);
  gpiod_line* const line = gpiod_chip_get_line(handle_->chip, offset);
  if (line == nullptr) return failed_call(what, errno);
  const int done = direction == Direction::output ? gpiod_line_request_output(line, "supercoil", 0)
                                                  : gpiod_line_request_input(line, "supercoil");
  if (done != 0) return failed_call(what, errno);
  return HeldLine(
      HeldLine::Owned(new HeldLine::Handle{std::exchange(handle_->chip, nullptr), line}));
}

hal::Status HeldLine::set(bool high) noexcept {
  return gpiod_line_set_value(handle_->line, high ? 1 : 0) == 0 ? hal::Status::ok
                                                                : status_of(errno);
}

hal::Level HeldLine::get() noexcept {
  const int value = gpiod_line_get_value(handle_->line);
  if (value < 0) return {false, status_of(errno)};
  return {value != 0, hal::Status::ok};
}

}  // namespace supercoil::hal_linux
