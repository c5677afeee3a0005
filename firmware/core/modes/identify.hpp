// Learning a muscle's parameters on command.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "supercoil/control/estimation/batch_least_squares.hpp"

#include "modes/excitation.hpp"
#include "modes/result.hpp"

namespace supercoil::modes {

/// Excites the muscle at its own pace, fits it, and judges each parameter by itself. A muscle is
/// found when θ2 to θ4, which controllers use, are known (θ2 roughly), explain the last third of
/// the experiment, and lie within a range of the believed ones. An uncertain θ1 stays as believed;
/// so do γ and m̂, which position and power never give. If a parameter stays uncertain, as many
/// strokes again follow, and all are judged together. If the model explains too little, or a
/// parameter is still uncertain, shorter strokes follow, twice at most. A slow muscle is judged
/// after each stroke: once it is found, or does not fit, more of the same strokes would only take
/// time.
class Identify {
 public:
  struct Settings {
    double max_s = 2400.0;  ///< then the data so far must do
    /// After this the muscle is judged after each stroke, once there are enough of them; a slow one
    /// once they can be fitted.
    double patience_s = 100.0;
    std::size_t enough_strokes = 4;
    /// Of the unseen third's variance. Muscles with the effects of docs/muscles.md leave up to
    /// 0.02; one whose stiffness changes by a third during the experiment, 0.13 and more.
    double max_unexplained = 0.06;
    /// Likewise for the full strokes, by a muscle that shorter ones found.
    double max_unexplained_full = 0.5;
    double max_deviation = 0.1;  ///< standard deviation of each parameter, relative
    /// Likewise for a slow muscle's θ4, which takes the most strokes to determine.
    double max_slow_theta4_deviation = 0.15;
    double max_difference = 0.25;       ///< relative difference of the unseen third's own fit
    double max_theta2_deviation = 0.5;  ///< more refuses it; above max_deviation it is noted
    double min_ratio = 0.1;             ///< limits of each θ over the believed muscle's
    double max_ratio = 10.0;
  };

  /// How certain the last muscle that was found is. NaN: none was.
  struct Quality {
    /// Standard; NaN: kept. For a muscle found with shorter strokes, includes how far the full
    /// ones' fit is from theirs.
    control::Theta deviation_ratio = control::Theta::Constant(NAN);
    /// As in BatchLeastSquares::Fit. With shorter strokes, what the muscle that they found leaves
    /// of the full ones, if that is more.
    double unexplained_ratio = NAN;
  };

  /// max_travel_m: of the channel.
  Identify(const Settings& settings, const control::PhysicalParameters& believed,
           double max_travel_m, double step_s)
      : settings_(settings),
        believed_(believed),
        step_s_(step_s),
        excitation_({max_travel_m, step_s}),
        fit_(believed, step_s) {}

  /// position_m: where the unpowered muscle is.
  void start(double position_m) {
    elapsed_s_ = 0.0;
    notes_ = 0;
    power_W_ = 0.0;
    shortened_ = 0;
    repeats_ = 0;
    excitation_.start(position_m);
    fit_.start(position_m);
  }

  /// One tick: this tick's position, the power applied since the last one, and the power that is
  /// allowed now.
  ModeResult step(double position_m, double applied_power_W, double max_W) {
    elapsed_s_ += step_s_;
    const std::size_t cycle = excitation_.cycle();
    fit_.step(position_m, applied_power_W,
              excitation_.heated() ? std::optional(block_of(cycle)) : std::nullopt);
    power_W_ = excitation_.step(position_m, max_W);
    const bool ends = excitation_.done() || elapsed_s_ >= settings_.max_s;
    const bool stroke_ended = excitation_.cycle() != cycle;
    // A quick muscle's first stroke tells little.
    if (stroke_ended && cycle == 0 && !excitation_.slow()) fit_.restart();
    const std::size_t enough = excitation_.slow() ? fit_.min_blocks : settings_.enough_strokes;
    const bool early = stroke_ended && elapsed_s_ > settings_.patience_s && fit_.blocks() >= enough;
    return ends || early ? conclude(ends) : ModeResult::running;
  }

  double power_W() const { return power_W_; }
  /// 0 to 1. Repeats are not known beforehand, so each counts as half of what was left.
  float progress() const {
    return 1.0F - std::ldexp(1.0F - excitation_.progress(), -static_cast<int>(repeats_));
  }
  /// The full strokes did not fit, or left the muscle uncertain.
  bool shortened() const { return shortened_ > 0; }
  /// Above the cold muscle's position, smoothed.
  double risen_m() const { return excitation_.risen_m(); }
  /// How far above it the strokes go.
  double reach_m() const { return excitation_.reach_m(); }
  const control::PhysicalParameters& found() const { return found_; }
  const Quality& quality() const { return quality_; }
  /// IdentifyNotes of the last judgement; 0 while it runs. If a muscle was found, poor_fit means
  /// that it took shorter strokes.
  std::uint8_t notes() const { return notes_; }

 private:
  static constexpr std::uint8_t max_shortened = 2;

  /// The block of the fit that this stroke is.
  std::size_t block_of(std::size_t cycle) const {
    return cycle == 0 || excitation_.slow() ? cycle : cycle - 1;
  }

  /// Judges the strokes so far; ends: no more are to come.
  ModeResult conclude(bool ends);
  ModeResult judge();
  ModeResult go_on() {
    notes_ = 0;
    return ModeResult::running;
  }
  ModeResult shorten(ModeResult reason);
  bool knows(const control::BatchLeastSquares::Fit& fit, int i) const;
  bool usable_theta2(const control::BatchLeastSquares::Fit& fit) const;
  bool plausible(double theta, double believed) const;
  std::uint8_t reasons_against(const control::BatchLeastSquares::Fit& fit) const;
  double theta1(const control::BatchLeastSquares::Fit& fit);

  Settings settings_;
  control::PhysicalParameters believed_;
  double step_s_;
  double elapsed_s_ = 0.0;
  double power_W_ = 0.0;
  std::uint8_t repeats_ = 0;    ///< times excited again after the first
  std::uint8_t shortened_ = 0;  ///< of these, times with shorter strokes
  /// Of the full strokes, once they are shortened: what they showed, and how they ended.
  control::BatchLeastSquares::Sums full_strokes_;
  control::Theta full_theta_ = control::Theta::Constant(NAN);
  ModeResult full_result_ = ModeResult::none;
  std::uint8_t full_notes_ = 0;
  control::Theta theta_ = control::Theta::Constant(NAN);  ///< last fitted
  std::uint8_t notes_ = 0;
  Excitation excitation_;
  control::BatchLeastSquares fit_;
  control::PhysicalParameters found_;
  Quality quality_;
};

}  // namespace supercoil::modes
