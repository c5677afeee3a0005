// Proof at every start that both ways of cutting the heat really cut it.
#pragma once

namespace supercoil {

/// A probe's duty is set twice: once while the charge pump stands still and the enable line is
/// high, once while the pump runs and the line is low. A healthy board never carries any
/// current while it is tested: current at any time is a failure.
class SelfTest {
 public:
  struct Settings {
    double pump_decay_s;     ///< the last life of this board may have pumped until just now
    double settle_s = 0.05;  ///< of the current sense: five of its time constants at least
    double pulse_s = 0.03;   ///< four of them at least
  };
  struct Lines {
    bool heartbeat = false;
    bool enable = false;
    bool pulse = false;  ///< the probe's duty is on
  };
  enum class Outcome { waiting, running, passed, pump_does_not_open, enable_does_not_cut };

  SelfTest(const Settings& settings, double step_s) : settings_(settings), step_s_(step_s) {}

  /// Of this tick; all low when it neither runs nor has passed.
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

  /// One tick. may_run: without it the test stops, cold, and begins again when it may. Then the
  /// most current that any channel shows, and what an idle channel may show.
  void step(bool may_run, double current_A, double idle_A) {
    if (passed() || failed()) return;
    if (!may_run) {
      restart();
      return;
    }
    const Lines before = lines();  // in force while that current flowed
    outcome_ = Outcome::running;
    elapsed_s_ += step_s_;
    // The sense may show the last life's current until the pump has decayed.
    if (elapsed_s_ <= settings_.pump_decay_s + settings_.settle_s) return;
    // A mean over the pulse's second half: single readings are noise. A switch that is stuck on
    // carries far more than a probe, and is not given the time of a mean.
    if (before.pulse && pulse_elapsed_s_ > 0.5 * settings_.pulse_s) {
      sum_A_ += current_A;
      ++count_;
    }
    pulse_elapsed_s_ = before.pulse ? pulse_elapsed_s_ + step_s_ : 0.0;
    over_s_ = !(current_A <= far_more * idle_A) ? over_s_ + step_s_ : 0.0;
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
  /// Nothing is proven any more.
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
  static constexpr double far_more = 4.0;

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
