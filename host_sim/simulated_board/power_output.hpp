// What becomes of a wanted power on its way into the muscle.
#pragma once

#include <array>
#include <cstddef>

namespace supercoil::host_sim {

struct PowerSettings {
  double max_W = 4.5;
  double min_W = 0.0;
  int pwm_bits = 0;            ///< 0: ideal
  double full_scale_W = 14.4;  ///< power at a duty of 1: 12 V on 10 Ω
  bool error_feedback = true;  ///< what rounding took from one duty is added to the next
  double delay_s = 0.0;        ///< actuation delay, rounded to whole ticks
  double gain = 1.0;           ///< power in the muscle over power reported, what nobody measures

  friend bool operator==(const PowerSettings&, const PowerSettings&) = default;
};

/// Clips (Eq. (19)), quantises and delays.
class PowerOutput {
 public:
  static constexpr std::size_t longest_delay_ticks = 256;

  PowerOutput(const PowerSettings& settings, double step_s);
  /// The delay line keeps what is under way.
  void set(const PowerSettings& settings);

  /// Takes this tick's wanted power (a NaN is the least power).
  void want(double power_W);

  /// The power that acts until the next tick, as the board knows it.
  double applied_W() const { return acting_.power_W; }
  /// The same as it really is in the muscle.
  double true_W() const { return acting_.power_W * settings_.gain; }
  /// Whether the acting power is not the one that was wanted for it.
  bool limited() const { return acting_.limited; }

 private:
  struct Command {
    double power_W = 0.0;
    bool limited = false;
  };

  double quantised(double power_W);

  PowerSettings settings_;
  double step_s_;
  std::size_t delay_ticks_ = 0;
  std::array<Command, longest_delay_ticks + 1> line_{};
  std::size_t head_ = 0;
  double rounding_error_ = 0.0;
  Command acting_;
};

}  // namespace supercoil::host_sim
