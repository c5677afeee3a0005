// Proof at every start that both ways of cutting the heat really cut it.
#pragma once

namespace supercoil {

/// A probe's duty is set twice: once with the charge pump stopped and the enable line high, once
/// with the pump running and the line low. A healthy board carries no current during the test: any
/// current is a failure.
class SelfTest {
 public:
  struct Settings {
    double pump_decay_s;     ///< the pump may have run right up to this start
    double settle_s = 0.05;  ///< at least five time constants of the current sense
    double pulse_s = 0.03;   ///< at least four of them
  };
  /// How the board's lines and duties must be set in this tick.
  struct Lines {
    bool heartbeat = false;
    bool enable = false;
    bool pulse = false;  ///< the probe's duty is on
  };
  /// The last two name the cut that failed to stop the current.
  enum class Outcome { waiting, running, passed, pump_does_not_open, enable_does_not_cut };

  SelfTest(const Settings& settings, double step_s) : settings_(settings), step_s_(step_s) {}

  /// The lines in this tick; all low unless the test runs or has passed.
  Lines lines() const {
    if (outcome_ != Outcome::running) return {passed(), false, false};
    const double pump_at_s = settings_.pump_decay_s + settings_.settle_s;
    const double enable_at_s = pump_at_s + settings_.pulse_s + settings_.settle_s;
    const bool pump = within(pump_at_s);
    return {elapsed_s_ >= pump_at_s + settings_.pulse_s, pump, pump || within(enable_at_s)};
  }
  double duration_s() const {
    return settings_.pump_decay_s + 3.0 * settings_.settle_s + 2.0 * settings_.pulse_s;
  }

  /// One tick. Without may_run the test stops, cold, and starts again once it may. current_A: the
  /// maximum of all channels; idle_A: what an idle channel may show.
  void step(bool may_run, double current_A, double idle_A) {
    if (passed() || failed()) return;
    if (!may_run) {
      restart();
      return;
    }
    const Lines before = lines();  // in force while that current flowed
    outcome_ = Outcome::running;
    elapsed_s_ += step_s_;
    // Until the pump has decayed, the sense may show current from before the start.
    if (elapsed_s_ <= settings_.pump_decay_s + settings_.settle_s) return;
    // A mean over the pulse's second half: single readings are noise. A switch that is stuck on
    // carries far more than a probe, and is detected without waiting for the mean.
    if (before.pulse && pulse_elapsed_s_ > 0.5 * settings_.pulse_s) {
      sum_A_ += current_A;
      ++count_;
    }
    pulse_elapsed_s_ = before.pulse ? pulse_elapsed_s_ + step_s_ : 0.0;
    over_s_ = !(current_A <= fast_trip_ratio * idle_A) ? over_s_ + step_s_ : 0.0;
    const bool pulse_ends = before.pulse && !lines().pulse;
    const bool mean_over = pulse_ends && !(count_ > 0 && sum_A_ <= idle_A * count_);
    if (mean_over || over_s_ > 0.3 * settings_.pulse_s) {
      outcome_ = before.heartbeat ? Outcome::enable_does_not_cut : Outcome::pump_does_not_open;
    } else if (elapsed_s_ >= duration_s()) {
      outcome_ = Outcome::passed;
    }
    if (pulse_ends) {
      sum_A_ = 0.0;
      count_ = 0;
    }
  }
  /// Discards what was proven.
  void restart() {
    outcome_ = Outcome::waiting;
    elapsed_s_ = pulse_elapsed_s_ = over_s_ = sum_A_ = 0.0;
    count_ = 0;
  }

  Outcome outcome() const { return outcome_; }
  bool under_way() const { return outcome_ == Outcome::running; }
  bool passed() const { return outcome_ == Outcome::passed; }
  bool failed() const {
    return outcome_ == Outcome::pump_does_not_open || outcome_ == Outcome::enable_does_not_cut;
  }

 private:
  static constexpr double fast_trip_ratio = 4.0;

  bool within(double from_s) const {
    return elapsed_s_ >= from_s && elapsed_s_ < from_s + settings_.pulse_s;
  }

  Settings settings_;
  double step_s_;
  double elapsed_s_ = 0.0;
  double over_s_ = 0.0;
  double pulse_elapsed_s_ = 0.0;
  double sum_A_ = 0.0;
  int count_ = 0;
  Outcome outcome_ = Outcome::waiting;
};

}  // namespace supercoil
