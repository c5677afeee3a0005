// Proof at every start that both ways of cutting the heat really cut it.
#pragma once

namespace supercoil {

/// A probe's duty is set twice: once while the charge pump stands still and the enable line is
/// high, once while the pump runs and the line is low. Current in either is a failure. A board that
/// is well never carries any.
class SelfTest {
 public:
  struct Settings {
    double pump_decay_s;     ///< the last life of this board may have pumped until just now
    double settle_s = 0.05;  ///< of the current sense
    double pulse_s = 0.03;
  };
  struct Lines {
    bool heartbeat = false;
    bool enable = false;
    bool pulse = false;  ///< the probe's duty is on
  };
  enum class Verdict { running, passed, pump_does_not_open, enable_does_not_cut };

  SelfTest(const Settings& settings, double step_s) : settings_(settings), step_s_(step_s) {}

  /// Of this tick.
  Lines lines() const {
    const double pump_at_s = settings_.pump_decay_s + settings_.settle_s;
    const double enable_at_s = pump_at_s + settings_.pulse_s + settings_.settle_s;
    const bool pump = within(pump_at_s);
    const bool enable = within(enable_at_s);
    return {elapsed_s_ >= pump_at_s + settings_.pulse_s, pump, pump || enable};
  }
  double duration_s() const {
    return settings_.pump_decay_s + 3.0 * settings_.settle_s + 2.0 * settings_.pulse_s;
  }

  /// One tick: the most current that any channel shows, and what an idle channel may show.
  void step(double current_A, double idle_A) {
    if (verdict_ != Verdict::running) return;
    const Lines now = lines();
    elapsed_s_ += step_s_;
    if (now.pulse && !(current_A <= idle_A)) {
      over_ += step_s_;
      // Noise is no failure; half a pulse of current is.
      if (over_ > 0.3 * settings_.pulse_s) {
        verdict_ = now.enable ? Verdict::pump_does_not_open : Verdict::enable_does_not_cut;
      }
    }
    if (!now.pulse) over_ = 0.0;
    if (verdict_ == Verdict::running && elapsed_s_ >= duration_s()) verdict_ = Verdict::passed;
  }
  Verdict verdict() const { return verdict_; }

 private:
  bool within(double from_s) const {
    return elapsed_s_ >= from_s && elapsed_s_ < from_s + settings_.pulse_s;
  }

  Settings settings_;
  double step_s_;
  double elapsed_s_ = 0.0;
  double over_ = 0.0;
  Verdict verdict_ = Verdict::running;
};

}  // namespace supercoil
