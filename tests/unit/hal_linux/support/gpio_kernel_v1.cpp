// libgpiod 1, as far as hal/linux calls it.
#include <gpiod.h>

#include "unit/hal_linux/support/gpio_kernel.hpp"

using supercoil::test::FakeChip;
using supercoil::test::FakeLine;
using supercoil::test::gpio_kernel;

namespace {

// Opaque: the library's types for our own objects.
gpiod_chip* handle(FakeChip* chip) {
  return reinterpret_cast<gpiod_chip*>(chip);
}
FakeChip& chip_of(gpiod_chip* chip) {
  return *reinterpret_cast<FakeChip*>(chip);
}
FakeLine& line_of(gpiod_line* line) {
  return *reinterpret_cast<FakeLine*>(line);
}
const char* text_or_null(const std::string& text) {
  return text.empty() ? nullptr : text.c_str();
}

}  // namespace

extern "C" {
gpiod_chip* gpiod_chip_open(const char* path) {
  return handle(gpio_kernel().open(path));
}
void gpiod_chip_close(gpiod_chip* /*chip*/) {
  --gpio_kernel().opened;
}
const char* gpiod_chip_name(gpiod_chip* chip) {
  return chip_of(chip).name.c_str();
}
const char* gpiod_chip_label(gpiod_chip* chip) {
  return chip_of(chip).label.c_str();
}
unsigned gpiod_chip_num_lines(gpiod_chip* chip) {
  return static_cast<unsigned>(chip_of(chip).lines.size());
}
gpiod_line* gpiod_chip_get_line(gpiod_chip* chip, unsigned offset) {
  return reinterpret_cast<gpiod_line*>(&chip_of(chip).lines.at(offset));
}
const char* gpiod_line_name(gpiod_line* line) {
  return text_or_null(line_of(line).name);
}
const char* gpiod_line_consumer(gpiod_line* line) {
  return text_or_null(line_of(line).consumer);
}
int gpiod_line_bias(gpiod_line* line) {
  using supercoil::hal_linux::Bias;
  switch (line_of(line).bias) {
    case Bias::none:
      return GPIOD_LINE_BIAS_DISABLE;
    case Bias::pull_up:
      return GPIOD_LINE_BIAS_PULL_UP;
    case Bias::pull_down:
      return GPIOD_LINE_BIAS_PULL_DOWN;
    case Bias::unknown:
      break;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}
int gpiod_line_request_output(gpiod_line* line, const char* consumer, int value) {
  return gpio_kernel().request(line_of(line), true, value, consumer);
}
int gpiod_line_request_input(gpiod_line* line, const char* consumer) {
  return gpio_kernel().request(line_of(line), false, 0, consumer);
}
void gpiod_line_release(gpiod_line* line) {
  supercoil::test::GpioKernel::release(line_of(line));
}
int gpiod_line_set_value(gpiod_line* line, int value) {
  return gpio_kernel().set(line_of(line), value);
}
int gpiod_line_get_value(gpiod_line* line) {
  return gpio_kernel().get(line_of(line));
}
}
