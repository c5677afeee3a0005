#include "supercoil/hal_linux/sysfs_pwm.hpp"

#include <cerrno>
#include <utility>

namespace supercoil::hal_linux {

namespace {

/// numerator * factor / denominator to the nearest whole number; none is negative.
std::int64_t scaled(std::int64_t numerator, std::int64_t factor, std::int64_t denominator) {
  return (numerator * factor + denominator / 2) / denominator;
}

/// Within these limits, step * period_ns fits into 64 bits many times over.
constexpr std::int64_t max_period_ns = 1'000'000'000;
constexpr int max_steps = 1 << 24;

}  // namespace

Result<std::unique_ptr<SysfsPwm>> SysfsPwm::open(const PwmLocation& place) {
  if (place.steps < 1 || place.steps > max_steps) {
    return failure("a PWM of " + std::to_string(place.steps) + " steps: must be 1 to 16777216");
  }
  if (place.period_ns < place.steps || place.period_ns > max_period_ns) {
    return failure("a PWM period of " + std::to_string(place.period_ns) +
                   " ns: must be 1 ns a step (" + std::to_string(place.steps) + ") to 1 s");
  }
  auto files = open_pwm_files(place);
  if (!files) return tl::unexpected(files.error());
  if (auto prepared = prepare_pwm(*files, place.period_ns); !prepared) {
    return tl::unexpected(prepared.error());
  }
  return std::make_unique<SysfsPwm>(std::move(*files), place.period_ns, place.steps);
}

SysfsPwm::SysfsPwm(PwmFiles files, std::int64_t period_ns, int steps)
    : files_(std::move(files)), period_ns_(period_ns), steps_(steps) {}

SysfsPwm::~SysfsPwm() {
  static_cast<void>(files_.duty.write(0));
  static_cast<void>(files_.enable.write(0));
}

hal::Status SysfsPwm::set(int step) {
  if (step < 0 || step > steps_) return hal::Status::out_of_range;
  return files_.duty.write(scaled(step, period_ns_, steps_));
}

hal::Status SysfsPwm::pulse_enable() const {
  const hal::Status disabled = files_.enable.write(0);
  const hal::Status enabled = files_.enable.write(1);
  return disabled == hal::Status::ok ? enabled : disabled;
}

int SysfsPwm::read_back() const {
  const Number duty_ns = files_.duty.number();
  if (duty_ns.status != hal::Status::ok) return -1;
  if (duty_ns.value < 0 || duty_ns.value > period_ns_) return -1;
  return static_cast<int>(scaled(duty_ns.value, steps_, period_ns_));
}

}  // namespace supercoil::hal_linux
