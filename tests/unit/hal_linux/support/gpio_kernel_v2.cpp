// libgpiod 2, as far as hal/linux calls it.
#include <string>

#include <gpiod.h>

#include "unit/hal_linux/support/gpio_kernel.hpp"

using supercoil::test::FakeChip;
using supercoil::test::FakeLine;
using supercoil::test::gpio_kernel;

// The library only declares these types.
struct gpiod_line_settings {
  bool output;
  int value;
};
struct gpiod_line_config {
  unsigned offset;
  gpiod_line_settings settings;
};
struct gpiod_request_config {
  std::string consumer;
};
struct gpiod_line_request {
  FakeLine* line;
  unsigned offset;
};

namespace {

template <class Handle>
FakeChip& chip_of(Handle* chip) {
  return *reinterpret_cast<FakeChip*>(chip);
}
FakeLine& line_of(gpiod_line_info* line) {
  return *reinterpret_cast<FakeLine*>(line);
}
const char* text_or_null(const std::string& text) {
  return text.empty() ? nullptr : text.c_str();
}
/// The request holds only this line.
FakeLine* line_of(gpiod_line_request* request, unsigned offset) {
  return request->offset == offset ? request->line : nullptr;
}

}  // namespace

extern "C" {
gpiod_chip* gpiod_chip_open(const char* path) {
  return reinterpret_cast<gpiod_chip*>(gpio_kernel().open(path));
}
void gpiod_chip_close(gpiod_chip* /*chip*/) {
  --gpio_kernel().opened;
}
gpiod_chip_info* gpiod_chip_get_info(gpiod_chip* chip) {
  return reinterpret_cast<gpiod_chip_info*>(chip);
}
void gpiod_chip_info_free(gpiod_chip_info* /*info*/) {}
const char* gpiod_chip_info_get_name(gpiod_chip_info* info) {
  return chip_of(info).name.c_str();
}
const char* gpiod_chip_info_get_label(gpiod_chip_info* info) {
  return chip_of(info).label.c_str();
}
std::size_t gpiod_chip_info_get_num_lines(gpiod_chip_info* info) {
  return chip_of(info).lines.size();
}
gpiod_line_info* gpiod_chip_get_line_info(gpiod_chip* chip, unsigned offset) {
  return reinterpret_cast<gpiod_line_info*>(&chip_of(chip).lines.at(offset));
}
void gpiod_line_info_free(gpiod_line_info* /*info*/) {}
const char* gpiod_line_info_get_name(gpiod_line_info* info) {
  return text_or_null(line_of(info).name);
}
const char* gpiod_line_info_get_consumer(gpiod_line_info* info) {
  return text_or_null(line_of(info).consumer);
}
gpiod_line_bias gpiod_line_info_get_bias(gpiod_line_info* line) {
  using supercoil::hal_linux::Bias;
  switch (line_of(line).bias) {
    case Bias::none:
      return GPIOD_LINE_BIAS_DISABLED;
    case Bias::pull_up:
      return GPIOD_LINE_BIAS_PULL_UP;
    case Bias::pull_down:
      return GPIOD_LINE_BIAS_PULL_DOWN;
    case Bias::unknown:
      break;
  }
  return GPIOD_LINE_BIAS_UNKNOWN;
}
gpiod_line_settings* gpiod_line_settings_new() {
  return new gpiod_line_settings{false, 1};
}
void gpiod_line_settings_free(gpiod_line_settings* settings) {
  delete settings;
}
int gpiod_line_settings_set_direction(gpiod_line_settings* settings,
                                      gpiod_line_direction direction) {
  settings->output = direction == GPIOD_LINE_DIRECTION_OUTPUT;
  return 0;
}
int gpiod_line_settings_set_output_value(gpiod_line_settings* settings, gpiod_line_value value) {
  settings->value = value == GPIOD_LINE_VALUE_ACTIVE ? 1 : 0;
  return 0;
}
gpiod_line_config* gpiod_line_config_new() {
  return new gpiod_line_config{};
}
void gpiod_line_config_free(gpiod_line_config* config) {
  delete config;
}
int gpiod_line_config_add_line_settings(gpiod_line_config* config, const unsigned* offsets,
                                        std::size_t /*count*/, gpiod_line_settings* settings) {
  *config = {*offsets, *settings};
  return 0;
}
gpiod_request_config* gpiod_request_config_new() {
  return new gpiod_request_config{};
}
void gpiod_request_config_free(gpiod_request_config* config) {
  delete config;
}
void gpiod_request_config_set_consumer(gpiod_request_config* config, const char* consumer) {
  config->consumer = consumer;
}
gpiod_line_request* gpiod_chip_request_lines(gpiod_chip* chip, gpiod_request_config* request,
                                             gpiod_line_config* config) {
  FakeLine& line = chip_of(chip).lines.at(config->offset);
  const int done = gpio_kernel().request(line, config->settings.output, config->settings.value,
                                         request->consumer.c_str());
  return done == 0 ? new gpiod_line_request{&line, config->offset} : nullptr;
}
void gpiod_line_request_release(gpiod_line_request* request) {
  supercoil::test::GpioKernel::release(*request->line);
  delete request;
}
int gpiod_line_request_set_value(gpiod_line_request* request, unsigned offset,
                                 gpiod_line_value value) {
  return gpio_kernel().set(*line_of(request, offset), value == GPIOD_LINE_VALUE_ACTIVE ? 1 : 0);
}
gpiod_line_value gpiod_line_request_get_value(gpiod_line_request* request, unsigned offset) {
  const int value = gpio_kernel().get(*line_of(request, offset));
  if (value < 0) return GPIOD_LINE_VALUE_ERROR;
  return value == 0 ? GPIOD_LINE_VALUE_INACTIVE : GPIOD_LINE_VALUE_ACTIVE;
}
}
