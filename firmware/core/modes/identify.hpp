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
/// the experiment, and lie within a span of what is believed. What is not known of θ1 stays as
/// believed; position and power never give γ and m̂, so they do too. Strokes that leave a parameter
/// uncertain are followed by as many more, which are judged together with them. A muscle of which
/// the model explains too little, or that stays uncertain, is excited with shorter strokes, twice
/// at most. A slow muscle is judged after each stroke: once it is found, or does not fit, more of
/// the same strokes would only take time.
class Identify {
 public:
  struct Settings {
    double max_s = 2400.0;  ///< then what there is must do
    /// From then on the muscle is judged after each stroke, once there are enough of them; a slow
    /// one as soon as they can be fitted.
    double patience_s = 100.0;
    std::size_t enough_strokes = 4;
    /// Of the unseen third's variance. Muscles with the effects of docs/muscles.md leave up to
    /// 0.02; one whose stiffness changes by a third under way, 0.13 and more.
    double max_unexplained = 0.06;
    /// Likewise, of the full strokes, by a muscle that shorter ones found.
    double max_unexplained_full = 0.5;
    double max_deviation = 0.1;  ///< standard, of each parameter, relative
    /// Likewise, of a slow muscle's θ4, which takes most strokes to know.
    double max_slow_theta4_deviation = 0.15;
    double max_difference = 0.25;       ///< of the unseen third's own fit, relative
    double max_theta2_deviation = 0.5;  ///< more than this refuses it; between, it is noted
    double min_ratio = 0.1;             ///< each θ within these ratios to the believed muscle's
    double max_ratio = 10.0;
  };

  /// How sure the last muscle that was found is. NaN: none was.
  struct Quality {
    /// Standard; NaN: kept. Of a muscle that shorter strokes found, with how far the full ones' fit
    /// is from theirs.
    control::Theta deviation_ratio = control::Theta::Constant(NAN);
    /// As BatchLeastSquares::Fit has it. Where it took shorter strokes, what the muscle that they
    /// found leaves of the full ones, if that is more.
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

  /// The muscle is here, and gets no power.
  void start(double position_m) {
    elapsed_s_ = 0.0;
    notes_ = 0;
    power_W_ = 0.0;
    shortened_ = 0;
    again_ = 0;
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
    // A quick muscle's first stroke teaches little.
    if (stroke_ended && cycle == 0 && !excitation_.slow()) fit_.start_anew();
    const std::size_t enough = excitation_.slow() ? fit_.min_blocks : settings_.enough_strokes;
    const bool early = stroke_ended && elapsed_s_ > settings_.patience_s && fit_.blocks() >= enough;
    return ends || early ? conclude(ends) : ModeResult::running;
  }

  double power_W() const { return power_W_; }
  /// 0 to 1; that it is excited again is not known beforehand: each time is half of what was left.
  float progress() const {
    return 1.0F - std::ldexp(1.0F - excitation_.progress(), -static_cast<int>(again_));
  }
  /// The full strokes did not fit, or left the muscle uncertain.
  bool shortened() const { return shortened_ > 0; }
  /// Above the cold muscle's position, smoothed.
  double risen_m() const { return excitation_.risen_m(); }
  const control::PhysicalParameters& found() const { return found_; }
  const Quality& quality() const { return quality_; }
  /// IdentifyNotes of the last judgement; 0 while it runs. With a muscle that was found, poor_fit
  /// says that it took shorter strokes.
  std::uint8_t notes() const { return notes_; }

 private:
  static constexpr std::uint8_t max_shortened = 2;

  /// Of the fit, that this stroke is.
  std::size_t block_of(std::size_t cycle) const {
    return cycle == 0 || excitation_.slow() ? cycle : cycle - 1;
  }

  /// What the strokes so far say; ends: no more of them are to come.
  ModeResult conclude(bool ends);
  ModeResult judge();
  ModeResult go_on() {
    notes_ = 0;
    return ModeResult::running;
  }
  ModeResult shorten(ModeResult because);
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
  std::uint8_t again_ = 0;      ///< excited so often, after the first time
  std::uint8_t shortened_ = 0;  ///< so often of these, by shorter strokes
  /// The full ones, where they are shortened: what they showed, and how they ended.
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
