// Finding a PWM output and bringing it into a known state.
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <string>
#include <thread>

#include <unistd.h>

#include "supercoil/hal_linux/sysfs_pwm.hpp"

namespace supercoil::hal_linux {

namespace {

constexpr std::array<const char*, 4> files_of_output{"period", "duty_cycle", "enable", "polarity"};

/// udev gives a new output's files to their group shortly after they appear. If they are still not
/// writable then, opening them reports it.
void wait_for_rights(const std::string& folder) {
  constexpr int max_rounds = 100;
  constexpr auto round = std::chrono::milliseconds(10);
  const auto may_write = [&](const char* name) {
    return ::access((folder + "/" + name).c_str(), W_OK) == 0 || errno != EACCES;
  };
  for (int i = 0; i < max_rounds && !std::ranges::all_of(files_of_output, may_write); ++i)
    std::this_thread::sleep_for(round);
}

Result<void> export_output(const DeviceFolder& chip, int number) {
  const auto count = read_integer(chip.folder + "/npwm");
  if (!count) return tl::unexpected(count.error());
  if (number < 0 || number >= *count) {
    return failure(chip.describe() + " has " + std::to_string(*count) +
                   " outputs, counted from 0; there is no " + std::to_string(number));
  }
  const std::string folder = chip.folder + "/pwm" + std::to_string(number);
  if (!real_path(folder).empty()) return {};
  auto written = write_text(chip.folder + "/export", std::to_string(number));
  if (!written && written.error().code == std::errc::device_or_resource_busy) {
    return failed_call("output " + std::to_string(number) + " of " + chip.describe() +
                           " is used by a kernel driver (see /sys/kernel/debug/pwm)",
                       EBUSY);
  }
  if (written) wait_for_rights(folder);
  return written;
}

Result<PwmFiles> open_files(const std::string& folder) {
  const auto open = [&](const char* name) {
    return Attribute::open(folder + "/" + name, Attribute::Use::both);
  };
  auto period = open("period");
  if (!period) return tl::unexpected(period.error());
  auto duty = open("duty_cycle");
  if (!duty) return tl::unexpected(duty.error());
  auto enable = open("enable");
  if (!enable) return tl::unexpected(enable.error());
  auto polarity = open("polarity");
  if (!polarity) return tl::unexpected(polarity.error());
  return PwmFiles{std::move(*period), std::move(*duty), std::move(*enable), std::move(*polarity)};
}

/// The state that was left behind.
struct PwmState {
  std::int64_t period_ns;
  std::int64_t duty_ns;
  bool enabled;
  bool inversed;
};

Result<PwmState> state_of(const PwmFiles& files) {
  const auto period = files.period.integer();
  if (!period) return tl::unexpected(period.error());
  const auto duty = files.duty.integer();
  if (!duty) return tl::unexpected(duty.error());
  const auto enabled = files.enable.integer();
  if (!enabled) return tl::unexpected(enabled.error());
  const auto polarity = files.polarity.text();
  if (!polarity) return tl::unexpected(polarity.error());
  if (*period < 0 || *duty < 0) return failure(files.period.path() + " or its duty is negative");
  return PwmState{*period, *duty, *enabled != 0, *polarity == "inversed"};
}

/// Writes one value after the other, until one fails.
class Writes {
 public:
  void set(const Attribute& attribute, std::string_view text) {
    if (result_) result_ = attribute.set(text);
  }
  void set(const Attribute& attribute, std::int64_t value) {
    set(attribute, std::to_string(value));
  }
  Result<void> result() const { return result_; }

 private:
  Result<void> result_;
};

}  // namespace

Result<std::vector<DeviceFolder>> pwm_chips(const std::string& root) {
  auto chips = numbered_folders(root, "pwmchip");
  if (!chips) return chips;
  for (DeviceFolder& chip : *chips) {
    chip.device_path = real_path(chip.folder + "/device");
    // On I²C and SPI the device has the part's name ("pca9685"); others only have their folder's.
    if (const auto name = read_text(chip.folder + "/device/name"); name && !name->empty()) {
      chip.names.push_back(*name);
    }
    if (!chip.device_path.empty()) chip.names.push_back(base_name(chip.device_path));
  }
  return chips;
}

Result<PwmFiles> open_pwm_files(const PwmLocation& place) {
  return pwm_chips(place.root)
      .and_then(
          [&](const auto& chips) { return choose(chips, place.device, "PWM chip", place.root); })
      .and_then([&](const DeviceFolder& chip) -> Result<PwmFiles> {
        if (auto exported = export_output(chip, place.number); !exported) {
          return tl::unexpected(exported.error());
        }
        return open_files(chip.folder + "/pwm" + std::to_string(place.number));
      });
}

// The kernel judges the whole state after each write: it refuses any that leaves the period 0 or
// the duty above it (6.1; from 6.8 only of an enabled output), and a new polarity while enabled.
Result<void> prepare_pwm(const PwmFiles& files, std::int64_t period_ns) {
  const auto left = state_of(files);
  if (!left) return tl::unexpected(left.error());
  Writes writes;
  // Without a period nothing else is accepted, nor ever a period shorter than the duty. A driver
  // may also report a duty above its period; it then takes only a new duty or a longer period.
  const bool stuck = left->period_ns == 0 || (left->inversed && left->duty_ns > left->period_ns);
  if (stuck) writes.set(files.period, std::max(period_ns, left->duty_ns));
  if (left->inversed) {
    // While inversed, a duty of 0 is always on: not yet. The polarity changes only while disabled.
    writes.set(files.enable, 0);
    writes.set(files.polarity, "normal");
  }
  writes.set(files.duty, 0);
  writes.set(files.period, period_ns);
  writes.set(files.enable, 1);
  if (!writes.result()) return writes.result();
  const auto now = state_of(files);
  if (!now) return tl::unexpected(now.error());
  if (now->period_ns != period_ns || now->duty_ns != 0 || !now->enabled || now->inversed) {
    return failure(parent_of(files.period.path()) + " took every write and now shows period " +
                   std::to_string(now->period_ns) + " ns, duty " + std::to_string(now->duty_ns) +
                   " ns, enable " + std::to_string(now->enabled ? 1 : 0) +
                   (now->inversed ? ", inversed" : ", normal") + ": wanted period " +
                   std::to_string(period_ns) + " ns, duty 0, enable 1, normal");
  }
  return {};
}

}  // namespace supercoil::hal_linux
