// The reference over time.
#pragma once

#include <string_view>
#include <vector>

#include "supercoil/control/scalar/arithmetic.hpp"

namespace supercoil::host_sim {

enum class ReferenceKind { sine, step, steps, multisine, power };

inline constexpr control::Names<ReferenceKind, 5> reference_names{
    {{"sine", ReferenceKind::sine},
     {"step", ReferenceKind::step},
     {"steps", ReferenceKind::steps},
     {"multisine", ReferenceKind::multisine},
     {"power", ReferenceKind::power}}};

/// One term: amplitude·sin(ωt).
struct Sinusoid {
  double amplitude;
  double angular_frequency_rad_per_s;
  friend bool operator==(const Sinusoid&, const Sinusoid&) = default;
};

/// A position in metres, or for `power` a power in watts, as a function of time.
struct Reference {
  ReferenceKind kind = ReferenceKind::sine;
  double offset = 0.011;                       ///< sine, multisine, power
  std::vector<Sinusoid> terms{{0.009, 0.25}};  ///< sine, multisine, power
  std::vector<double> levels;  ///< step: before and after; steps: one after the other
  double hold_s = 20.0;        ///< step: when; steps: how long each

  friend bool operator==(const Reference&, const Reference&) = default;

  double at(double time_s) const;
  /// The minimum and the maximum that it can take.
  double min() const;
  double max() const;
  /// The hold of `steps`, or the shortest period of the terms; infinite for `step`.
  double min_period_s() const;
};

/// Eq. (18) of the paper: sin t + sin 0.5t + sin 0.25t + 2.5, in watts.
Reference paper_excitation();

}  // namespace supercoil::host_sim
