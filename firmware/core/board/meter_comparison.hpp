// A channel's senses compared with a meter.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "board/learned.hpp"
#include "board/power_bounds.hpp"
#include "supervisor/channel_state.hpp"

namespace supercoil::board {

/// A person reads a meter at two powers; one reading alone changes nothing. While the power is
/// steady the senses are averaged, as the meter's display is. The gains are found when four
/// readings agree with each other and with the configured resistance. A reading that does not is
/// refused and all are discarded, as it is unknown which was wrong.
class MeterComparison {
 public:
  struct Settings {
    double min_supply_V = 9.0;
    double max_supply_V = 15.0;
    double resistance_tolerance_ratio = 0.3;
    double supply_step_V = 0.0;  ///< of a count
    double current_step_A = 0.0;
  };
  /// Which of the channel's two senses the meter is compared with.
  enum Sense : std::uint8_t { supply, current };

  static constexpr double min_gain = 0.7;
  static constexpr double max_gain = 1.4;
  static constexpr double min_level_ratio = 1.4;    ///< of the second power over the first
  static constexpr double same_level_ratio = 0.05;  ///< duties this close are of one power
  static constexpr double max_spread_ratio = 0.02;  ///< of a sense's gains at both, plus rounding
  static constexpr double meter_ratio = 0.01;       ///< error of an ordinary meter
  static constexpr double floor_ratio = 0.01;       ///< for errors that two powers do not show
  static constexpr double max_error_ratio = 0.2;

  MeterComparison(const Settings& settings, double step_s)
      : settings_(settings),
        steady_ticks_(static_cast<int>(std::lround(steady_s / step_s))),
        min_weight_(step_s / smoothing_s) {}

  /// A tick at unchanged power, with what the senses measure.
  void step(double duty, double supply_V, double current_A) {
    if (ticks_ < steady_ticks_) ++ticks_;
    // In the first half the power is still settling.
    if (2 * ticks_ <= steady_ticks_) return;
    duty_ += weight_ * (duty - duty_);
    reported_[supply] += weight_ * (supply_V - reported_[supply]);
    reported_[current] += weight_ * (current_A - reported_[current]);
    // A mean, until it is as long as the low-pass.
    if (weight_ > min_weight_) weight_ = std::max(min_weight_, weight_ / (1.0 + weight_));
  }
  /// The power changes, or a sense has no value.
  void restart() {
    ticks_ = 0;
    weight_ = 1.0;
  }
  void forget() { levels_ = {}; }
  /// A reading was taken, and more are to follow.
  bool begun() const {
    return std::any_of(levels_.begin(), levels_.end(),
                       [](const Level& level) { return level.duty > 0.0; });
  }

  /// meter: what it shows now, volts at the supply's terminals or mean amperes. present: corrects
  /// the senses now. resistance_Ohm: range of the configured heater at its present temperature.
  Refusal read(Sense sense, double meter, const board::SenseComparison& present,
               const PowerBounds::Interval& resistance_Ohm) {
    if (ticks_ < steady_ticks_) return Refusal::not_ready;
    const double corrected_by = sense == supply ? present.supply_gain : present.current_gain;
    const Reading reading{meter, reported_[sense] / corrected_by};
    if (!is_plausible(sense, reading)) return refuse();
    const auto level = level_here();
    if (!level) return Refusal::not_ready;
    levels_[*level].duty = duty_;
    levels_[*level].readings[sense] = reading;
    const double allowed_ratio = max_spread_ratio + rounding_ratio(sense);
    if (!fits(levels_[*level], resistance_Ohm) || spread_ratio(sense) > allowed_ratio)
      return refuse();
    return !is_complete() || found() ? Refusal::none : refuse();
  }

  /// When all four readings agree.
  std::optional<board::SenseComparison> found() const {
    if (!is_complete()) return std::nullopt;
    const double error_ratio =
        floor_ratio + std::max({meter_ratio, spread_ratio(supply), spread_ratio(current),
                                count_ratio(supply), count_ratio(current)});
    if (!(error_ratio <= max_error_ratio)) return std::nullopt;
    return board::SenseComparison{mean_gain(supply), mean_gain(current), error_ratio, 0.0};
  }

 private:
  static constexpr double steady_s = 1.0;
  static constexpr double smoothing_s = 0.5;

  struct Reading {
    double meter = 0.0;  ///< 0: none yet
    double sensed = 0.0;
    bool is_present() const { return meter > 0.0; }
    double gain() const { return meter / sensed; }
  };
  struct Level {
    double duty = 0.0;
    std::array<Reading, 2> readings;
  };

  Refusal refuse() {
    forget();
    return Refusal::out_of_range;
  }
  /// Written so that NaN is not plausible.
  bool is_plausible(Sense sense, const Reading& r) const {
    if (sense == supply &&
        !(r.meter >= settings_.min_supply_V && r.meter <= settings_.max_supply_V))
      return false;
    return r.sensed > 0.0 && r.gain() >= min_gain && r.gain() <= max_gain;
  }
  /// Which of the two powers acts; empty: neither the first nor far enough above it.
  std::optional<std::size_t> level_here() const {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double known = levels_[i].duty;
      if (known > 0.0 && std::abs(duty_ - known) <= same_level_ratio * known) return i;
      const bool above = i == 0 || duty_ >= min_level_ratio * levels_[0].duty;
      if (known == 0.0 && above) return i;
    }
    return std::nullopt;
  }
  /// Also finds volts and amperes that were swapped.
  bool fits(const Level& level, const PowerBounds::Interval& resistance_Ohm) const {
    const auto& [volts, amperes] = level.readings;
    if (!volts.is_present() || !amperes.is_present()) return true;
    const double meter_Ohm = level.duty * volts.meter / amperes.meter;
    const double tolerance = settings_.resistance_tolerance_ratio;
    return meter_Ohm >= resistance_Ohm.min * (1.0 - tolerance) &&
           meter_Ohm <= resistance_Ohm.max * (1.0 + tolerance);
  }
  bool is_complete() const {
    return std::all_of(levels_.begin(), levels_.end(), [](const Level& level) {
      return level.readings[supply].is_present() && level.readings[current].is_present();
    });
  }
  double mean_gain(Sense sense) const {
    return 0.5 * (levels_[0].readings[sense].gain() + levels_[1].readings[sense].gain());
  }
  double spread_ratio(Sense sense) const {
    const Reading& first = levels_[0].readings[sense];
    const Reading& second = levels_[1].readings[sense];
    if (!first.is_present() || !second.is_present()) return 0.0;
    return std::abs(first.gain() - second.gain()) / mean_gain(sense);
  }
  double step_of(Sense sense) const {
    return std::abs(sense == supply ? settings_.supply_step_V : settings_.current_step_A);
  }
  /// One count of the converter over the smaller reading.
  double count_ratio(Sense sense) const {
    return step_of(sense) /
           std::min(levels_[0].readings[sense].sensed, levels_[1].readings[sense].sensed);
  }
  /// Max difference between two correct gains if each reading is half a count off. The remaining
  /// error includes a count, so it covers a typing error that small.
  double rounding_ratio(Sense sense) const {
    double ratio = 0.0;
    for (const Level& level : levels_) {
      const Reading& r = level.readings[sense];
      if (r.is_present()) ratio += 0.5 * step_of(sense) / r.sensed;
    }
    return ratio;
  }

  Settings settings_;
  int steady_ticks_;
  double min_weight_;
  int ticks_ = 0;
  double weight_ = 1.0;
  double duty_ = 0.0;
  std::array<double, 2> reported_{};  ///< smoothed, by Sense
  std::array<Level, 2> levels_;
};

}  // namespace supercoil::board
