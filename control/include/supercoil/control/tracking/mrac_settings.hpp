// The design constants of the direct model reference adaptive controller, and named sets of them.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "supercoil/control/estimation/projection.hpp"
#include "supercoil/control/linear/polynomial.hpp"

namespace supercoil::control {

/// Constants of Eqs. (9)–(17). Order of θ and Π: θ1 (on s·u/λ, u/λ), θ2 (on s·y/λ, y/λ), θ3 (on y),
/// c0 (on r). The defaults are the paper's (Sec. 5.2).
struct MracSettings {
  using Parameters = Vector<double, 6>;

  std::array<double, 2> alpha{1.0, 1.0};  ///< α(s) = [alpha[0] s, alpha[1]]
  Polynomial<2> lambda{2.0, 3.0, 1.0};    ///< λ(s), monic, ascending
  double p0_rad_per_s = 4.0;
  double p1_rad_per_s = 5.0;
  double q0_rad_per_s = 0.8;
  Parameters gain{6.0, 6.0, 6.0, 7.0, 2.0, 3.0};  ///< diagonal of Π before adaptation_scale
  double sigma_gain = 4.0;                        ///< ν before adaptation_scale
  double adaptation_scale = 1.0;                  ///< Π and ν are the two above multiplied by it
  double damping = 3.0;                           ///< α0 of Eq. (17); 0 leaves ua = θ̇ᵀφ1
  Parameters initial = Parameters::Zero();        ///< θ(0)
  double initial_sigma = 0.0;                     ///< σ(0)

  bool freeze_when_limited = true;  ///< θ and σ rest while the power is not the demanded one
  double sigma_modification = 0.0;  ///< leak of θ towards θ(0): θ̇ −= this·Π(θ − θ(0))
  double dead_zone_W = 0.0;         ///< θ and σ rest while |ε1| is smaller
  std::optional<Box<double, 6>> bounds;  ///< θ is projected onto it
  bool accept_failed_premises = false;   ///< runs without the proof of its stability

  Parameters scaled_gain() const { return gain * adaptation_scale; }          ///< Π
  double scaled_sigma_gain() const { return sigma_gain * adaptation_scale; }  ///< ν
  /// Π and ν multiplied by a factor > 0.
  MracSettings scaled(double factor) const;
};

/// The presets' names, each with a description for lists.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 2> mrac_presets{{
    {"printed", "the paper's constants (Sec. 5.2); adaptation_scale = 10 tracks better"},
    {"a", "the best of the paper's own laws: faster filters, gains x 20 (default)"},
}};

/// The power of the paper's muscle at most (Sec. 5.2), for which the presets were designed.
inline constexpr double paper_max_W = 4.5;

/// Presets: "printed", the paper's constants; "a", design A: α = [20 s, 400], λ = (s + 20)², Π and
/// ν × 20, α0 = 1, c0(0) = 0.3, which tracks an order of magnitude better (docs/paper.md). Both are
/// for signals in watts at rest. Π and ν of "a" are scaled by (paper_max_W / max_W)², so that
/// muscles of any max_W > 0 adapt equally fast. Empty for any other name.
std::optional<MracSettings> mrac_preset(std::string_view name, double max_W = paper_max_W);

}  // namespace supercoil::control
