// Distinguishes a change of the muscle from a model that is not quite right.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::control {

/// How slow a muscle is: θ3/θ4, its thermal time constant, over that of the paper's muscle, on
/// which the times of filters and detectors were tuned.
inline double slowness(const Theta& theta) {
  constexpr double typical_thermal_s = 1.945;
  return theta[2] / theta[3] / typical_thermal_s;
}

/// A directional likelihood ratio. A change moves the parameters along a known direction d, and so
/// the residual e along s = dᵀψ: over a short window, g = E[s e]²/E[s²] is how much of the
/// residual's power the change explains. Model error also leaves residuals, but those recur with
/// the motion: g must exceed a multiple of its largest earlier value.
///
/// First trials with these settings: 3 false changes in 24 runs of 1000 s of random steps over
/// twelve kinds of simulated muscles (docs/muscles.md), two of them where heat transfer alone
/// depends on temperature. With a ratio of 6 a softening by a quarter was missed at two of eight
/// phases on the hardest muscle. What the laws report: docs/control-theory.md,
/// docs/estimation-theory.md.
template <int Directions>
class ChangeDetector {
 public:
  using Signals = Vector<double, Directions>;

  /// Times are for a muscle with a thermal time constant of 1.95 s.
  struct Settings {
    double period_s;           ///< between steps
    double floor_rms;          ///< g must always exceed its square; in the residual's unit
    double window_s = 0.7;     ///< of the expectations
    double delay_s = 2.5;      ///< before g counts as past
    double memory_s = 1000.0;  ///< in which the largest g is forgotten
    double ratio = 5.0;        ///< to the largest earlier g
    double settle_s = 15.0;    ///< earlier errors come from the start
    double blind_s = 90.0;     ///< no change is reported before
    double repeat_s = 5.0;     ///< between changes

    /// Scales all times of motion for a muscle this many times slower.
    void stretch(double slow) {
      window_s *= slow;
      delay_s *= slow;
      settle_s *= slow;
      repeat_s *= slow;
    }
  };

  explicit ChangeDetector(const Settings& s)
      : settings_(s),
        smoothing_(-std::expm1(-s.period_s / s.window_s)),
        fade_(std::exp(-s.period_s / s.memory_s)),
        slot_steps_(std::max<std::int64_t>(
            1, std::llround(s.delay_s / s.period_s / static_cast<double>(slots)))) {}

  /// One observation. Returns the direction of a change when it sees one.
  std::optional<int> step(const Signals& signals, double residual) {
    ++steps_;
    correlation_ += smoothing_ * (signals * residual - correlation_);
    square_ += smoothing_ * (signals.cwiseProduct(signals) - square_);
    const Signals gain =
        correlation_.cwiseProduct(correlation_).cwiseQuotient(square_.cwiseMax(1e-300));
    follow_past(gain);
    const Signals limit =
        settings_.ratio * past_ + Signals::Constant(settings_.floor_rms * settings_.floor_rms);
    int best = 0;
    const double ratio = gain.cwiseQuotient(limit).maxCoeff(&best);
    if (!(ratio > 1.0) || running_s() < settings_.blind_s || since_s() < settings_.repeat_s)
      return std::nullopt;
    changed_ = steps_;
    return best;
  }

  /// How far along a direction the parameters have moved, according to the last window.
  double amount(int direction) const {
    return square_[direction] > 0.0 ? correlation_[direction] / square_[direction] : 0.0;
  }
  /// Call after moving the parameters, which makes the window's contents obsolete.
  void forget_window() {
    correlation_.setZero();
    square_.setZero();
    slots_.fill(Signals::Zero());
  }

 private:
  static constexpr std::size_t slots = 32;

  double running_s() const { return static_cast<double>(steps_) * settings_.period_s; }
  double since_s() const {
    return changed_ == 0 ? INFINITY : static_cast<double>(steps_ - changed_) * settings_.period_s;
  }

  /// Slots of the delay hold the largest g within them.
  void follow_past(const Signals& gain) {
    past_ *= fade_;
    slots_[slot_] = slots_[slot_].cwiseMax(gain);
    if (++in_slot_ < slot_steps_) return;
    in_slot_ = 0;
    slot_ = (slot_ + 1) % slots;
    if (running_s() > settings_.settle_s) past_ = past_.cwiseMax(slots_[slot_]);
    slots_[slot_].setZero();
  }

  Settings settings_;
  double smoothing_;
  double fade_;
  std::int64_t slot_steps_;
  std::int64_t steps_ = 0;
  std::int64_t changed_ = 0;
  std::int64_t in_slot_ = 0;
  std::size_t slot_ = 0;
  Signals correlation_ = Signals::Zero();  // E[s e]
  Signals square_ = Signals::Zero();       // E[s²]
  Signals past_ = Signals::Zero();         // the largest g before the delay
  std::array<Signals, slots> slots_{};
};

}  // namespace supercoil::control
