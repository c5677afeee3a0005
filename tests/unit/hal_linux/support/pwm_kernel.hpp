// A sysfs PWM chip that accepts and refuses writes as the kernel does.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "unit/hal_linux/support/temporary_folder.hpp"

namespace supercoil::test {

/// Which writes are refused.
enum class Rules {
  strict,        ///< 6.1: any state with period 0 or duty above the period
  since_6_8,     ///< the same, except from one such state to another
  enabled_only,  ///< the same, but only while the output is enabled
};

struct PwmState {
  std::int64_t period_ns = 0;
  std::int64_t duty_ns = 0;
  bool enabled = false;
  bool inversed = false;

  /// The fraction of time in which the output is high.
  double on() const;
  friend bool operator==(const PwmState&, const PwmState&) = default;
};

/// One chip, pwmchip3 at devices/soc/i2c-1/1-0040, with 16 outputs of which one can be exported.
/// During its lifetime it receives the writes to attributes.
class PwmKernel {
 public:
  explicit PwmKernel(const PwmState& left = {}, bool exported = true, Rules rules = Rules::strict,
                     int number = 5);
  PwmKernel(const PwmKernel&) = delete;
  PwmKernel& operator=(const PwmKernel&) = delete;
  ~PwmKernel();

  std::string root() const { return tree / "class/pwm"; }

  TemporaryFolder tree;
  PwmState state;
  std::vector<std::string> writes;    ///< "duty_cycle 0"
  std::vector<std::string> refusals;  ///< of these, the ones answered with EINVAL
  double max_on = 0.0;                ///< over all states that were accepted

 private:
  long write(const std::string& path, std::string_view text);
  long apply(const PwmState& wanted);
  void show(std::string_view attribute) const;
  void show_all() const;

  Rules rules_;
  std::string output_;
};

}  // namespace supercoil::test
