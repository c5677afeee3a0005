// Gives in the next period, ahead of time, what the feedback had to add in this one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace supercoil::control {

/// Iterative learning control for a reference that repeats itself. A period has 1024 slots. Half of
/// what the feedback added in one period, shifted earlier by the time that the muscle needs to
/// answer, is added to the output there. A zero-phase average of both suppresses components
/// that a longer lag would make grow from period to period.
class IterativeLearning {
 public:
  /// Times are for a muscle with a thermal time constant of 1.95 s. Found by trials on `real` and
  /// `real_hard`: a width of 0.06 s diverges on the latter.
  struct Settings {
    double period_s = 0.0;  ///< of the reference; 0: it does not repeat itself
    double lead_s = 0.08;
    double average_s = 0.13;     ///< half of the width
    double learning_gain = 0.5;  ///< on the feedback
    double retention = 0.99;     ///< from period to period, so that noise does not pile up
  };

  /// step_s: > 0, between ticks.
  IterativeLearning(const Settings& s, double step_s) : settings_(s), step_s_(step_s) {
    set_period(s.period_s);
  }

  /// Sets the reference's period; 0: it does not repeat itself. Implies reset().
  void set_period(double period_s) {
    settings_.period_s = period_s;
    phase_step_ = period_s > 0.0 ? step_s_ / period_s : 0.0;
    lead_ = slots_of(settings_.lead_s);
    half_width_ = slots_of(settings_.average_s);
    reset();
  }

  /// Begins a period, with nothing learned.
  void reset() {
    phase_ = 0.0;
    slot_ = 0;
    period_ = 0;
    begin_slot();
    forget();
  }
  /// Forgets what was learned; the period goes on.
  void forget() {
    feedback_W_.fill(0.0F);
    for (Slots& output : output_W_)
      output.fill(0.0F);
  }

  /// The power to add at this tick.
  double power_W() const {
    if (phase_step_ == 0.0) return 0.0;
    const double place = phase_ * static_cast<double>(slots);
    const double left = std::floor(place);
    const Slots& output_W = output_W_[(period_ + 1) % 2];
    const auto i = static_cast<std::size_t>(left) % slots;
    return output_W[i] + (place - left) * (output_W[(i + 1) % slots] - output_W[i]);
  }

  /// Ends the tick. feedback_W: what the feedback added; usable: it is informative.
  void step(double feedback_W, bool usable) {
    if (phase_step_ == 0.0) return;
    sum_W_ += feedback_W;
    count_ += 1.0;
    usable_ = usable_ && usable;
    phase_ += phase_step_;
    if (phase_ >= 1.0) phase_ -= 1.0;
    const auto now = static_cast<std::size_t>(phase_ * static_cast<double>(slots)) % slots;
    while (slot_ != now)
      end_slot();
  }

 private:
  static constexpr std::size_t slots = 1024;
  static constexpr std::size_t max_half_width = slots / 16;
  using Slots = std::array<float, slots>;

  std::size_t slots_of(double time_s) const {
    const double count = time_s * phase_slots_per_s();
    return static_cast<std::size_t>(std::fmin(std::round(count), max_half_width));
  }
  double phase_slots_per_s() const {
    return settings_.period_s > 0.0 ? static_cast<double>(slots) / settings_.period_s : 0.0;
  }

  void begin_slot() {
    sum_W_ = 0.0;
    count_ = 0.0;
    usable_ = true;
  }

  /// A slot that no tick fell into takes its neighbour's value.
  void end_slot() {
    const float last_W = feedback_W_[(slot_ + slots - 1) % slots];
    const float mean_W = count_ > 0.0 ? static_cast<float>(sum_W_ / count_) : last_W;
    feedback_W_[slot_] = usable_ ? mean_W : 0.0F;
    // The slots around the learned one are known by now; it may belong to the previous period.
    const std::size_t delay = lead_ + half_width_;
    if (slot_ >= delay) {
      learn(slot_ - delay, period_);
    } else if (period_ > 0) {
      learn(slot_ + slots - delay, period_ - 1);
    }
    if (++slot_ == slots) {
      slot_ = 0;
      ++period_;
    }
    begin_slot();
  }

  /// Computes what the next period gives at this slot.
  void learn(std::size_t slot, std::uint64_t period) {
    const Slots& output_W = output_W_[(period + 1) % 2];
    double sum_W = 0.0;
    for (std::size_t i = 0; i <= 2 * half_width_; ++i) {
      const std::size_t at = slot + slots - half_width_ + i;
      sum_W += settings_.retention * output_W[at % slots] +
               settings_.learning_gain * feedback_W_[(at + lead_) % slots];
    }
    output_W_[period % 2][slot] =
        static_cast<float>(sum_W / static_cast<double>(2 * half_width_ + 1));
  }

  Settings settings_;
  double step_s_;
  double phase_step_ = 0.0;
  std::size_t lead_ = 0;
  std::size_t half_width_ = 0;
  Slots feedback_W_{};
  std::array<Slots, 2> output_W_{};  // [p % 2]: for the period after p; the other one: for p
  double phase_ = 0.0;
  std::size_t slot_ = 0;
  std::uint64_t period_ = 0;
  double sum_W_ = 0.0;
  double count_ = 0.0;
  bool usable_ = true;
};

}  // namespace supercoil::control
