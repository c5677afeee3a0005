// The only place where raw counts become units.
#pragma once

#include "supercoil/hal/adc_channel.hpp"

namespace supercoil::board {

/// A value with its age. A value that is too old, or could not be read, is absent, never the old
/// number.
struct Measured {
  double value = 0.0;
  double age_s = 0.0;
  bool present = false;
  hal::Status status = hal::Status::not_ready;
};

/// unit = counts · per_count + offset.
struct Scaling {
  double per_count = 1.0;
  double offset = 0.0;
};

/// max_age_s > 0. A conversion from the future (a clock that went wrong) is absent as well.
inline Measured measure(const hal::Sample& sample, const Scaling& scaling, hal::Time now,
                        double max_age_s) {
  Measured result;
  result.status = sample.status;
  if (sample.status != hal::Status::ok) return result;
  result.age_s = hal::seconds(now - sample.taken);
  result.present = result.age_s >= 0.0 && result.age_s <= max_age_s;
  if (result.present) result.value = sample.counts * scaling.per_count + scaling.offset;
  return result;
}

/// The heater's resistance, which can only be measured while current flows.
class Resistance {
 public:
  /// sense: "averaged" (low-passed current: R = d·V/I) is what boards have that sample at any time.
  struct Settings {
    double probe_duty = 0.02;  ///< below this the last value is held
    double lowest_Ohm = 0.5;
    double highest_Ohm = 100.0;
  };
  explicit Resistance(const Settings& settings) : settings_(settings) {}

  /// One tick: the duty that was applied, the supply and the averaged current. Returns whether it
  /// measured.
  bool step(double duty, double supply_V, double current_A, double step_s) {
    age_s_ += step_s;
    if (!(duty >= settings_.probe_duty && current_A > 0.0 && supply_V > 0.0)) return false;
    const double measured_Ohm = duty * supply_V / current_A;
    plausible_ = measured_Ohm >= settings_.lowest_Ohm && measured_Ohm <= settings_.highest_Ohm;
    if (!plausible_) return false;
    value_Ohm_ = measured_Ohm;
    age_s_ = 0.0;
    return true;
  }

  /// 0 until it was measured once.
  double value_Ohm() const { return value_Ohm_; }
  double age_s() const { return age_s_; }
  /// Whether the newest attempt was inside the range; arming is refused when it was not.
  bool plausible() const { return plausible_; }

 private:
  Settings settings_;
  double value_Ohm_ = 0.0;
  double age_s_ = 0.0;
  bool plausible_ = false;
};

}  // namespace supercoil::board
