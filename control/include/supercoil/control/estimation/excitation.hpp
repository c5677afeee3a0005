// Whether the motion was rich enough for the estimates to deserve trust.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// Watches the smallest eigenvalue λmin of M = ∫φφᵀdt over a sliding window (persistence of
/// excitation), and how well the *present* θ predicts the whole window: E = ∫(z − θᵀφ)²dt, from the
/// window's ∫zφdt and ∫z²dt. Whatever θ° fits the window best, E ≥ (θ − θ°)ᵀM(θ − θ°), so |θ − θ°|
/// ≤ √(E/λmin), in the units of the regressors' scale, where every nominal parameter is 1. (The
/// running error ε = z − θᵀφ cannot replace E: while θ moves, adaptation keeps ε small wherever θ
/// is.) θ° is the muscle apart from noise: noise excites too, but it enters E in the same
/// proportion, so that without motion the bound stays near 1.
class ExcitationMonitor {
 public:
  /// The window, and the bound that makes an estimate trusted.
  struct Settings {
    double window_s = 20.0;
    /// The bound below which an estimate is trusted.
    double trusted_error = 0.2;
  };

  /// step_s: the sampling period in seconds, > 0.
  ExcitationMonitor(const Settings& settings, double step_s);

  /// One tick: z = θᵀφ is the regression. Every window_s/16 one tick also solves a 4 × 4 eigenvalue
  /// problem (about 1 µs), and judges theta, the estimate at that tick.
  void step(const Vector<double, 4>& phi, double z, const Vector<double, 4>& theta) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j <= i; ++j)
        current_.information(i, j) += phi[i] * phi[j];
    }
    current_.correlation += phi * z;
    current_.energy += z * z;
    if (++ticks_in_block_ == ticks_per_block_) close_block(theta);
  }

  /// A pause: the window begins again.
  void restart();

  /// λmin in W²s over the last whole window; 0 until one has passed.
  double min_eigenvalue() const { return min_eigenvalue_; }
  /// The largest distance of θ from the window's best fit, relative to the nominal parameters;
  /// infinity until a window has passed. It judges θ as it was at the last sixteenth of a window.
  double error_bound() const { return error_bound_; }
  bool trusted() const { return error_bound_ <= trusted_error_; }

 private:
  static constexpr std::size_t blocks = 16;
  struct Block {
    Matrix<double, 4> information = Matrix<double, 4>::Zero();  // lower triangle
    Vector<double, 4> correlation = Vector<double, 4>::Zero();
    double energy = 0.0;
  };
  void close_block(const Vector<double, 4>& theta);

  double step_s_;
  double trusted_error_;
  std::int64_t ticks_per_block_;
  std::int64_t ticks_in_block_ = 0;
  std::size_t next_block_ = 0;
  std::size_t filled_ = 0;
  Block current_;
  std::array<Block, blocks> history_;
  double min_eigenvalue_ = 0.0;
  double error_bound_ = std::numeric_limits<double>::infinity();
};

}  // namespace supercoil::control
