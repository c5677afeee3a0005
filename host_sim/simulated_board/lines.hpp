// PWM, wires and watchdog on the simulated board.
#pragma once

#include <cstdint>
#include <utility>

#include <boost/circular_buffer.hpp>

#include "supercoil/hal/clock.hpp"
#include "supercoil/hal/digital_line.hpp"
#include "supercoil/hal/pwm_output.hpp"
#include "supercoil/hal/watchdog.hpp"

namespace supercoil::host_sim {

/// A PWM output whose duty acts some time after it was set.
class SimulatedPwm final : public hal::PwmOutput {
 public:
  SimulatedPwm(int steps, hal::Duration delay, const hal::Time& now)
      : steps_(steps), delay_(delay), now_(&now) {}

  hal::Status set(int step) override {
    if (refuses != hal::Status::ok) return refuses;
    if (step < 0 || step > steps_) return hal::Status::out_of_range;
    set_ = step;
    if (delay_ > hal::Duration{}) {
      pending_.push_back({*now_ + delay_, step});
    } else {
      act(step);
    }
    return hal::Status::ok;
  }
  int read_back() const override { return reads_wrong ? set_ + 1 : set_; }
  int steps() const override { return steps_; }

  /// The duty at the switch at `now`.
  double duty(hal::Time now) {
    while (!pending_.empty() && pending_.front().first <= now) {
      act(pending_.front().second);
      pending_.pop_front();
    }
    return duty_;
  }

  hal::Status refuses = hal::Status::ok;  ///< returned by set() instead of obeying, unless ok
  bool reads_wrong = false;

 private:
  void act(int step) { duty_ = static_cast<double>(step) / steps_; }

  int steps_;
  hal::Duration delay_;
  const hal::Time* now_;
  int set_ = 0;
  double duty_ = 0.0;  ///< in effect
  boost::circular_buffer<std::pair<hal::Time, int>> pending_{4096};
};

class SimulatedOutput final : public hal::DigitalOutput {
 public:
  hal::Status set(bool high) override {
    if (refuses != hal::Status::ok) return refuses;
    edges_ += high != high_ ? 1U : 0U;
    high_ = high;
    return hal::Status::ok;
  }
  bool high() const { return high_; }
  std::uint64_t edges() const { return edges_; }

  hal::Status refuses = hal::Status::ok;

 private:
  bool high_ = false;
  std::uint64_t edges_ = 0;
};

class SimulatedInput final : public hal::DigitalInput {
 public:
  hal::Level read() override { return level; }
  hal::Level level{true, hal::Status::ok};
};

class SimulatedWatchdog final : public hal::Watchdog {
 public:
  hal::Status feed() override {
    ++fed;
    return hal::Status::ok;
  }
  hal::Status release() override { return hal::Status::ok; }
  std::int64_t fed = 0;
};

/// Closes the supply switch while its input shows edges, and opens it by itself when they stop.
class ChargePump {
 public:
  explicit ChargePump(hal::Duration decay) : decay_(decay) {}

  bool closed(std::uint64_t edges, hal::Time now) {
    if (edges != edges_) {
      edges_ = edges;
      last_edge_ = now;
      pumped_ = true;
    }
    return stuck_closed || (pumped_ && now - last_edge_ < decay_);
  }

  bool stuck_closed = false;

 private:
  hal::Duration decay_;
  hal::Time last_edge_{};
  std::uint64_t edges_ = 0;
  bool pumped_ = false;
};

}  // namespace supercoil::host_sim
