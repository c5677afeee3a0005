// A PWM output through the kernel's sysfs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal/pwm_output.hpp"
#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/device_folder.hpp"

namespace supercoil::hal_linux {

/// Where a PWM output is, and how it is set up.
struct PwmLocation {
  std::string device;  ///< the chip's name, or the end of its device path when it holds a slash
  int number = 0;      ///< of the output on its chip
  std::int64_t period_ns = 0;  ///< at least `steps`
  int steps = 4095;            ///< of a period
  std::string root = "/sys/class/pwm";
};

/// The files of one exported output.
struct PwmFiles {
  Attribute period;
  Attribute duty;
  Attribute enable;
  Attribute polarity;
};

/// The PWM chips in root.
Result<std::vector<DeviceFolder>> pwm_chips(const std::string& root);

/// Finds the output, exports it if necessary, and opens its files. Writes nothing else.
Result<PwmFiles> open_pwm_files(const PwmLocation& place);

/// Brings an output from any state to duty 0, not inversed, its period, enabled; and verifies that
/// by reading back. The kernel accepts this order of writes in every state.
Result<void> prepare_pwm(const PwmFiles& files, std::int64_t period_ns);

/// A prepared output. Its duty is 0 when it is opened and again when it ends. It stays exported.
class SysfsPwm final : public hal::PwmOutput {
 public:
  static Result<std::unique_ptr<SysfsPwm>> open(const PwmLocation& place);
  SysfsPwm(PwmFiles files, std::int64_t period_ns, int steps);
  /// Duty 0 first: what a disabled output's pin does depends on the chip.
  ~SysfsPwm() override;

  hal::Status set(int step) override;
  /// The kernel's duty in whole steps; negative also when it is longer than the period.
  int read_back() const override;
  int steps() const override { return steps_; }

  /// For timing the device while its duty is 0: disables and enables it. The kernel does not pass
  /// on a duty that it believes is already set.
  hal::Status pulse_enable() const;

 private:
  PwmFiles files_;
  std::int64_t period_ns_;
  int steps_;
};

}  // namespace supercoil::hal_linux
