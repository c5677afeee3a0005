// A hot muscle at rest must prove from time to time that it still responds.
#pragma once

#include <cstdint>
#include <limits>

#include "board/heat.hpp"
#include "supervisor/dither.hpp"
#include "supervisor/small_signal.hpp"

namespace supercoil {

/// Settings of a proof. Powers and temperatures are those of the channel's limits.
struct ProofSettings {
  bool enabled = true;  ///< proof_of_response
  board::ThermalSettings thermal;
  double max_power_ratio = 1.0;  ///< true over measured power
  double max_W = 0.0;
  double derate_from_C = 0.0;
  double trip_C = 0.0;
  double position_noise_rms_m = 0.0;
  double count_m = 0.0;
  double obvious_m = 0.001;  ///< responding_min_m
  /// How much of the model's small motions arrives at the sensor, as identify measured it.
  double response_ratio = 1.0;
};

/// What a proof can do for one muscle; also used by `--check`.
struct ProofPlan {
  Dither dither;
  double safe_W = 0.0;  ///< held indefinitely at a quarter of min cooling, stays below derating
  /// If contact is lost while no more than this is given, that is detected before the limit.
  double provable_W = 0.0;

  /// Computes both powers for air warmer_K above the warmest configured, with the same dither.
  void adjust_for_air(const ProofSettings& settings, double warmer_K);
};
/// Chooses a dither that, if possible, is decided before the muscle could overheat. rate_Hz: of
/// ticks.
ProofPlan plan_proof(const ProofSettings& settings, const control::PhysicalParameters& muscle,
                     double rate_Hz);

/// Settings to measure the answer of a muscle that was just found and holds its position at hold_W.
/// max_hold_W: more may move it out of its travel.
SmallSignal::Settings plan_small_signal(const ProofSettings& settings,
                                        const control::PhysicalParameters& muscle, double hold_W,
                                        double max_hold_W, double rate_Hz);

/// Any motion that follows the power proves a muscle, whatever the loop does. No motion proves
/// nothing: a loop that holds the muscle against a fan or a load also changes the power. So, when
/// there is no motion, a dither is added, which nothing else follows. If it is not answered, the
/// power is removed, which moves a live muscle by far more than friction holds. If that is not
/// answered either, it is a fault.
class Proof {
 public:
  /// The inputs of a tick.
  struct Input {
    double power_W = 0.0;      ///< that acted since the last tick
    double dither_W = 0.0;     ///< the dither in power_W
    std::int64_t periods = 1;  ///< since the last tick
    bool present = false;      ///< whether there is a position
    double position_m = 0.0;
    double hottest_K = 0.0;
    bool heating = false;       ///< following a position or a power
    double warmer_air_K = 0.0;  ///< above the warmest configured
  };

  /// known: identified, or learned before. A muscle that is only believed is not judged.
  Proof(const ProofSettings& settings, const control::PhysicalParameters& muscle, bool known,
        double rate_Hz);

  /// One tick.
  void step(const Input& in);
  /// The muscle is a different one from now on. response_ratio: as in ProofSettings.
  void learn(const control::PhysicalParameters& muscle, double response_ratio);
  const ProofSettings& settings() const { return settings_; }
  /// Sets the max of true over measured power from now on, for the same muscle.
  void plan(double max_power_ratio, const control::PhysicalParameters& muscle);
  /// A new calibration moved every position; those of this step so far belong to the old one.
  void recalibrated() {
    settled_ = false;
    sums_.position_m = 0.0;
    sums_.positions = 0;
  }

  /// At this tick the muscle was seen to follow its power.
  bool answered() const { return answered_; }
  /// At this tick neither a dither nor the removal of power was answered.
  bool unanswered() const { return unanswered_; }
  /// The dither at this tick; 0: none.
  double dither_W() const { return dither_W_; }
  /// Demand and dither together, at most max_W. Near the maximum the demand is lowered, so that
  /// both halves of a dither fit.
  double with_dither_W(double demanded_W,
                       double max_W = std::numeric_limits<double>::infinity()) const {
    if (dither_W_ == 0.0) return demanded_W;
    return (lowers(demanded_W, max_W) ? room_W(max_W) : demanded_W) + dither_W_;
  }
  /// Whether with_dither_W() lowers this demand: less power acts than was demanded.
  bool lowers(double demanded_W, double max_W) const {
    return dither_W_ != 0.0 && demanded_W > room_W(max_W);
  }
  /// The maximum power allowed now.
  double max_W() const { return max_W_; }
  /// The same, but not lowered by a release, which is short: what a reference may count on.
  double held_W() const { return stage_ == Stage::released ? plan_.provable_W : max_W_; }
  /// What a muscle that holds its position at a limit may have to give up for dithers.
  double reserve_W() const { return active() ? plan_.dither.amplitude_W : 0.0; }
  /// In m: how far the position followed the power since its removal, and the minimum required.
  detectors::Margin margin() const;

 private:
  enum class Stage : std::uint8_t {
    watching,
    overdue,    ///< not proven in time: safe power until the muscle answers or is found silent
    released,   ///< a dither was not answered: no power, and the muscle must move
    moving,     ///< it moved: friction swallows a dither, so only its own motion proves it now
    swallowed,  ///< its motion does not prove it: safe power until it rests, then as after overdue
  };

  /// Smooths where a block begins: one step's noise there would affect all of the block.
  static constexpr double smoothing = 0.2;

  /// A model's motion, and how well the position follows it, both without their slow part.
  struct Match {
    ExpectedMotion motion;
    detectors::HighPass expected;
    detectors::HighPass measured;
    detectors::Response answer;
    detectors::Response::Result result = detectors::Response::Result::open;
    double expected_m = 0.0;  ///< with its slow part, as what follows
    double smooth_expected_m = 0.0;
    double smooth_position_m = 0.0;

    void expect(double power_W) { expected_m = motion.step(power_W); }
    void compare(double position_m) {
      smooth_expected_m += smoothing * (expected_m - smooth_expected_m);
      smooth_position_m += smoothing * (position_m - smooth_position_m);
      result = answer.step(expected.step(expected_m), measured.step(position_m));
    }
    /// Both forget earlier motion alike: it may be from before contact was lost.
    void restart() {
      expected.settle(smooth_expected_m);
      measured.settle(smooth_position_m);
      answer.restart();
    }
    /// The position jumped.
    void settle(double position_m) {
      smooth_expected_m = expected_m;
      smooth_position_m = position_m;
      restart();
    }
    bool answered() const { return result == detectors::Response::Result::answered; }
    bool silent() const { return result == detectors::Response::Result::silent; }
  };
  Match match_for(const control::PhysicalParameters& muscle, double corner_rad_per_s,
                  double response_ratio = 1.0) const;

  void end_step(const Input& in);
  void warm(double power_W, bool heating, double hottest_K);
  void compare(double position_m);
  void rest(double hottest_K);
  void judge(double power_W, double hottest_K);
  void judge_release(double hottest_K);
  void prove(double hottest_K);
  /// Whether a live muscle must have moved by now: the model moved far enough, or time is up.
  bool must_move() const;
  double time_to_limit_s(double hottest_K) const;
  bool is_used(double ratio, double reserve_s, double hottest_K) const;
  double decision_s() const;
  void enter(Stage stage);
  void allow();
  void begin_block();
  void end_block();
  void drive_dither(double power_W, double hottest_K);
  void stop_dither();
  bool active() const { return settings_.enabled && known_; }
  /// The demand to which a dither can be added.
  double room_W(double max_W) const {
    return std::fmin(std::fmin(settings_.max_W, max_W_), max_W) - plan_.dither.amplitude_W;
  }

  ProofSettings settings_;
  bool known_;
  double rate_Hz_;
  double step_s_;
  std::int64_t step_ticks_;
  ProofPlan plan_;
  Match all_;     ///< of all power
  Match dither_;  ///< of the dither alone

  struct Sums {
    double power_W = 0.0;
    double dither_W = 0.0;
    double position_m = 0.0;
    std::int64_t ticks = 0;
    std::int64_t positions = 0;
  };
  Sums sums_;  ///< of this step

  Stage stage_ = Stage::watching;
  bool settled_ = false;
  bool answered_ = false;
  bool unanswered_ = false;
  int dither_place_ = -1;  ///< -1: none
  double dither_W_ = 0.0;
  double max_W_ = INFINITY;
  double warmer_air_K_ = 0.0;
  double unproven_s_ = 0.0;  ///< above the safe power, without a break
  control::BasicIntervalEnd<double> uncooled_;
  double proven_K_ = 0.0;  ///< max rise when it last answered
  /// Rise of a muscle that lost contact then and had the worst cooling since; 0: not heated yet.
  double worst_K_ = 0.0;
  double block_s_ = 0.0;
  double stage_s_ = 0.0;
  double low_m_ = 0.0;  ///< of the expected position, since the stage began
  double high_m_ = 0.0;
};

}  // namespace supercoil
