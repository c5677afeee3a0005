// libgpiod 2: Debian 13. A request lives apart from its chip.
#include <cerrno>

#include <gpiod.h>

#include "supercoil/hal_linux/gpio_chip.hpp"
#include "supercoil/hal_linux/status_of.hpp"

namespace supercoil::hal_linux {

namespace {

/// Frees one of libgpiod's objects.
template <auto free>
struct Free {
  template <class Object>
  void operator()(Object* object) const noexcept {
    free(object);
  }
};

using LineInfo = std::unique_ptr<gpiod_line_info, Free<gpiod_line_info_free>>;
using Settings = std::unique_ptr<gpiod_line_settings, Free<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, Free<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, Free<gpiod_request_config_free>>;

std::string text_or_empty(const char* text) {
  return text == nullptr ? std::string{} : std::string{text};
}

bool settle(gpiod_line_settings* settings, Direction direction) {
  if (direction == Direction::input) {
    return gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT) == 0;
  }
  return gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT) == 0 &&
         gpiod_line_settings_set_output_value(settings, GPIOD_LINE_VALUE_INACTIVE) == 0;
}

Bias bias_of(gpiod_line_info* info) {
  switch (gpiod_line_info_get_bias(info)) {
    case GPIOD_LINE_BIAS_DISABLED:
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
  gpiod_chip_info* info;
};

struct HeldLine::Handle {
  gpiod_line_request* request;
  unsigned offset;
};

void GpioChip::Close::operator()(Handle* handle) const noexcept {
  gpiod_chip_info_free(handle->info);
  gpiod_chip_close(handle->chip);
  delete handle;
}

void HeldLine::Release::operator()(Handle* handle) const noexcept {
  gpiod_line_request_release(handle->request);
  delete handle;
}

Result<GpioChip> GpioChip::open(const std::string& path) {
  gpiod_chip* const chip = gpiod_chip_open(path.c_str());
  if (chip == nullptr) return failed_call("cannot open " + path, errno);
  std::unique_ptr<Handle, Close> handle(new Handle{chip, gpiod_chip_get_info(chip)});
  if (handle->info == nullptr) return failed_call("cannot ask " + path + " what it is", errno);
  return GpioChip(std::move(handle));
}

std::string GpioChip::name() const {
  return gpiod_chip_info_get_name(handle_->info);
}

std::string GpioChip::label() const {
  return gpiod_chip_info_get_label(handle_->info);
}

unsigned GpioChip::line_count() const {
  return static_cast<unsigned>(gpiod_chip_info_get_num_lines(handle_->info));
}

LineDescription GpioChip::describe(unsigned offset) const {
  const LineInfo info(gpiod_chip_get_line_info(handle_->chip, offset));
  if (!info) return {};
  return {text_or_empty(gpiod_line_info_get_name(info.get())),
          text_or_empty(gpiod_line_info_get_consumer(info.get())), bias_of(info.get())};
}

Result<HeldLine> GpioChip::request(unsigned offset, Direction direction) && {
  const std::string what = "cannot request line " + std::to_string(offset);
  const Settings settings(gpiod_line_settings_new());
  const LineConfig lines(gpiod_line_config_new());
  const RequestConfig config(gpiod_request_config_new());
  if (!settings || !lines || !config) return failed_call(what, ENOMEM);
  gpiod_request_config_set_consumer(config.get(), "supercoil");
  if (!settle(settings.get(), direction) ||
      gpiod_line_config_add_line_settings(lines.get(), &offset, 1, settings.get()) != 0) {
    return failed_call(what, errno);
  }
  gpiod_line_request* const request =
      gpiod_chip_request_lines(handle_->chip, config.get(), lines.get());
  if (request == nullptr) return failed_call(what, errno);
  return HeldLine(HeldLine::Owned(new HeldLine::Handle{request, offset}));
}

hal::Status HeldLine::set(bool high) noexcept {
  const auto value = high ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
  return gpiod_line_request_set_value(handle_->request, handle_->offset, value) == 0
             ? hal::Status::ok
             : status_of(errno);
}

hal::Level HeldLine::get() noexcept {
  const auto value = gpiod_line_request_get_value(handle_->request, handle_->offset);
  if (value == GPIOD_LINE_VALUE_ERROR) return {false, status_of(errno)};
  return {value == GPIOD_LINE_VALUE_ACTIVE, hal::Status::ok};
}

}  // namespace supercoil::hal_linux
