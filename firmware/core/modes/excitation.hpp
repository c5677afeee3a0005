// The power that tells the most about a muscle of which little is known.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace supercoil::modes {

/// Heats until the position reaches a level, lets the muscle cool until it reaches another, and so
/// on, with three superimposed sines that show the mechanics. The muscle itself sets the pace, so
/// its time constant need not be known; positions bound the motion, so its gain need not be known.
///
/// The first heating begins with a fiftieth of the allowed power, which then rises until the
/// position is as far as it may go, or rises no further. All later motion stays below that.
class Excitation {
 public:
  struct Settings {
    double max_travel_m;  ///< of the channel, > 0
    double step_s;
  };
  /// Times heated and cooled; as many again if that is not enough.
  static constexpr std::size_t cycles = 8;

  explicit Excitation(const Settings& settings) : settings_(settings) {}

  /// Begins from scratch, with a muscle that may still be warm.
  void start(double position_m) {
    *this = Excitation(settings_);
    position_m_ = position_m;
    begin(Phase::rest);
  }
  /// Begins again where the last stroke ended, with the power and the reach known by now, and with
  /// shorter strokes: they show less nonlinearity.
  void start_shorter() {
    reach_m_ *= shorter_ratio;
    cycle_ = 0;
    goes_on_ = false;
    begin(Phase::heat);
  }

  /// As many strokes again after those done. False: that was done before.
  bool go_on() {
    if (goes_on_) return false;
    goes_on_ = true;
    return true;
  }

  /// One tick: this tick's position. max_W: allowed now. Returns the power to give.
  double step(double position_m, double max_W) {
    const double power_W = next_W(position_m, max_W);
    energy_J_ += power_W * settings_.step_s;
    if (phase_ != Phase::rest) risen_m_s_ += risen_m() * settings_.step_s;
    return power_W;
  }

  bool done() const { return cycle_ >= (goes_on_ ? 2 : 1) * cycles || too_still_; }
  /// The search ended with less motion than is needed.
  bool too_little_motion() const { return too_still_; }
  /// As too_little_motion(), and it moved at least that far, against the direction of heating.
  bool moved_backwards() const { return too_still_ && reach_m_ <= -min_m(); }
  /// From 0; the first one searches for the power, and tells little about a quick muscle.
  std::size_t cycle() const { return cycle_; }
  /// The search has begun.
  bool heated() const { return phase_ != Phase::rest; }
  /// The muscle is so slow that its first stroke counts, and need not end at a low.
  bool slow() const { return slow_; }
  double risen_m() const { return position_m_ - cold_m_; }
  /// How far the strokes rise; 0: not known yet.
  double reach_m() const { return reach_m_; }
  /// Of these strokes, 0 to 1.
  float progress() const {
    const float half = phase_ == Phase::cool ? 0.5F : 0.0F;
    const std::size_t before = goes_on_ ? cycles : 0;
    return (static_cast<float>(cycle_ - before) + half) / static_cast<float>(cycles);
  }

 private:
  enum class Phase : std::uint8_t { rest, search, heat, cool };

  /// Of the channel's travel: the rest is for a muscle that overshoots.
  static constexpr double travel_ratio = 0.55;
  /// Of the travel: less motion is not enough to identify the muscle.
  static constexpr double min_ratio = 0.01;
  /// Likewise: a muscle that softens as it warms may give way a little at first.
  static constexpr double backwards_ratio = 0.1;
  static constexpr double first_ratio = 0.02;  ///< of the power
  /// Mean power while it cools, over the power that heats.
  static constexpr double cooling_ratio = 0.05;
  /// Of the reach: the most that the cooling power may hold, or the muscle would hardly reach its
  /// lows. 0.05 to 0.08 find equally many of the random muscles of docs/setup.md.
  static constexpr double held_ratio = 0.06;
  static constexpr double growth_s = 0.75;  ///< e-fold time of the power in the search
  static constexpr double smoothing_s = 0.05;
  /// How far a muscle's position lags behind its heat: mechanics of 7 rad/s.
  static constexpr double lag_s = 0.15;
  /// Of the position that the search has reached. Nearly full strokes: what they tell about a
  /// muscle with hysteresis depends least on their order.
  static constexpr std::array<double, 2> highs{0.85, 0.75};
  static constexpr std::array<double, 2> lows{0.15, 0.25};
  static constexpr double shorter_ratio = 0.7;
  static constexpr double first_check_s = 0.4;
  static constexpr double min_phase_s = 2.0;
  /// Of the longest phase so far: a slow muscle also reverses slowly, due to play and creep.
  static constexpr double min_phase_ratio = 0.2;
  /// A muscle that has not cooled from its reach to its lows after this is slow: its time constant
  /// is some 12 s or more.
  static constexpr double slow_s = 25.0;
  static constexpr double slow_low = 0.5;  ///< where its first stroke may end
  static constexpr double max_still_s = 25.0;

  double next_W(double position_m, double max_W);

  void begin(Phase phase) {
    if (phase_ != Phase::rest) longest_s_ = std::fmax(longest_s_, phase_s_);
    phase_ = phase;
    phase_s_ = 0.0;
    check_s_ = first_check_s;
    check_m_ = begin_m_ = position_m_;
  }
  /// The position has settled: in the last third of the phase it moved by less than a twentieth of
  /// the phase's whole motion. Checked at times that grow by a factor of 1.5, which suits any time
  /// constant (an exponential is stalled after four).
  bool stalled();
  void end_search(double ahead_m);
  /// A level reached at once is overshot by far; one that is not reached needs more power.
  void adapt_power(bool reached, double max_W);
  /// Mean power while it cools.
  double cooling_W() const;
  double level_m(const std::array<double, 2>& ratios) const {
    return cold_m_ + ratios[cycle_ % ratios.size()] * reach_m_;
  }
  double min_m() const { return min_ratio * settings_.max_travel_m; }
  double sines() const {
    return (std::sin(4.1 * time_s_) + std::sin(9.3 * time_s_) + std::sin(21.7 * time_s_)) / 3.0;
  }

  Settings settings_;
  Phase phase_ = Phase::rest;
  std::size_t cycle_ = 0;
  bool goes_on_ = false;
  bool slow_ = false;
  bool too_still_ = false;
  double time_s_ = 0.0;
  double phase_s_ = 0.0;
  double longest_s_ = 0.0;   ///< of the finished phases that heated or cooled
  double position_m_ = 0.0;  ///< smoothed
  double speed_m_per_s_ = 0.0;
  double cold_m_ = 0.0;
  double reach_m_ = 0.0;  ///< from cold_m_; 0: not known yet
  double power_W_ = 0.0;
  double energy_J_ = 0.0;   ///< given since the search began
  double risen_m_s_ = 0.0;  ///< integral of the rise since then
  double begin_m_ = 0.0;    ///< where this phase began
  double check_s_ = 0.0;    ///< time in the phase of the next check
  double check_m_ = 0.0;    ///< position at the last check
};

}  // namespace supercoil::modes
