// How fast the muscle cools, whatever its motion is like.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "supercoil/control/hysteresis/play.hpp"
#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// The thermal time constant ψ/η from power and position. Heat is assumed linear, τq̇ = P − q with
/// q the power that the muscle loses, and its motion any curve of q with hysteresis, inertia,
/// damping and a drift:
///   x + a₁ẋ + a₂ẍ = c₀ + c₁u + c₂u² + c₃u³ + c₄ play(u; r₁) + c₅ play(u; r₂) + c₆ t,  u = q/max_W.
/// That is linear in all but τ, so it is fitted for each of a series of τ; the one with the
/// smallest residual is found. A fit that assumes linear motion as well gets τ wrong by a factor of
/// up to 2.9 on a muscle whose force grows with temperature (docs/safety.md).
class CoolingFit {
 public:
  /// The muscle's possible range; all > 0.
  struct Settings {
    double min_time_constant_s = 0.5;  ///< possible time constants
    double max_time_constant_s = 6.0;
    double max_W = 4.5;
  };
  /// The time constant that explains the motion best.
  struct Found {
    double time_constant_s;
    double mean_W;  ///< the power at which it was found
  };

  static constexpr double max_unexplained = 0.01;  ///< of the position's variance
  static constexpr double settle_s = 6.0;          ///< not used, while filters and muscle settle

  /// step_s > 0. Allocates nothing.
  CoolingFit(const Settings& settings, double step_s);

  /// Forgets everything; the next step is the first.
  void start();
  /// One tick: this tick's position, and the power applied since the last one.
  void step(double position_m, double power_W);
  /// Empty when no τ explains the motion, or too many do.
  std::optional<Found> found() const;

 private:
  static constexpr std::size_t candidates = 40;
  static constexpr int terms = 9;
  static constexpr int filtered = 7;  ///< of these, through the low-pass
  static constexpr double target_step_s = 0.01;
  static constexpr double corner_rad_per_s = 4.0;  ///< of two equal low-passes
  static constexpr double margin = 1.3;            ///< around the possible range
  static constexpr double min_used_s = 20.0;
  static constexpr double fine_play = 0.03;  ///< of max_W
  static constexpr double coarse_play = 0.12;
  /// All candidates at least min_distance from the best leave at least min_sharpness times its
  /// residual.
  static constexpr std::size_t min_distance = 4;
  static constexpr double min_sharpness = 1.7;
  static constexpr double ridge = 1e-10;

  struct Fit {
    double tau_s = 1.0;
    double loss_W = 0.0;
    Play fine{fine_play};
    Play coarse{coarse_play};
    std::array<double, filtered> once{};
    std::array<double, filtered> twice{};
    Matrix<double, terms> information = Matrix<double, terms>::Zero();
    Vector<double, terms> correlation = Vector<double, terms>::Zero();
  };
  struct Position {
    double once = 0.0;
    double twice = 0.0;
    double sum = 0.0;
    double energy = 0.0;
  };

  void add_sample(double position_m, double power_W);
  void add_sample(Fit& fit, double x, double power_W, bool used) const;
  /// Unexplained fraction of the position's variance.
  double unexplained(const Fit& fit) const;
  double used_s() const;

  static constexpr double scale_m = 1e-3;

  Settings settings_;
  int ticks_ = 1;
  double step_s_ = 0.0;
  double smoothing_ = 0.0;
  std::array<Fit, candidates> fits_{};
  Position position_;
  std::int64_t steps_ = 0;
  int n_ = 0;
  double position_sum_m_ = 0.0;
  double power_sum_W_ = 0.0;
  double mean_W_ = 0.0;
};

}  // namespace supercoil::control
