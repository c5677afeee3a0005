// A short, small pulse that measures a heater's resistance.
#pragma once

namespace supercoil::board {

/// While it runs, the power stage applies the probe's duty. The second half of the pulse is
/// measured: by then the averaged current sense has settled.
class Probe {
 public:
  Probe(double duration_s, double step_s) : duration_s_(duration_s), step_s_(step_s) {}

  void start() {
    elapsed_s_ = drive_V_s_ = current_A_s_ = 0.0;
    running_ = true;
  }
  void stop() { running_ = false; }
  bool running() const { return running_; }

  /// A tick's result; `ended` is true in the last tick of the pulse.
  struct Result {
    bool ended = false;
    double resistance_Ohm = 0.0;  ///< 0: no current flowed
  };
  /// One tick: the duty as the sense averages it, the supply, the current.
  Result step(double duty, double supply_V, double current_A) {
    if (!running_) return {};
    elapsed_s_ += step_s_;
    if (elapsed_s_ > 0.5 * (duration_s_ + step_s_)) {
      drive_V_s_ += duty * supply_V;
      current_A_s_ += current_A;
    }
    if (elapsed_s_ + 0.5 * step_s_ < duration_s_) return {};
    running_ = false;
    const bool measured = drive_V_s_ > 0.0 && current_A_s_ > 0.0;
    return {true, measured ? drive_V_s_ / current_A_s_ : 0.0};
  }

 private:
  double duration_s_;
  double step_s_;
  double elapsed_s_ = 0.0;
  double drive_V_s_ = 0.0;
  double current_A_s_ = 0.0;
  bool running_ = false;
};

}  // namespace supercoil::board
