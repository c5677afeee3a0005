// How an estimator did in a trial.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "estimators/contender.hpp"
#include "estimators/trial.hpp"

namespace supercoil::host_sim::estimators {

/// Times are in seconds, infinite if it never stayed within the band; errors are relative.
struct Outcome {
  control::Theta to_5_percent_s;  ///< from rest until the last exit from ±5 % before the change
  control::Theta to_1_percent_s;
  control::Theta back_to_5_percent_s;  ///< from the change to the last exit before the end
  control::Theta steady_rms;           ///< the last 40 s before the change
  control::Theta reported_rms;         ///< of the standard deviations reported then; NaN without
  /// Errors at plotted_s after the start, and after the change, squared.
  std::vector<control::Theta> squares_from_rest;
  std::vector<control::Theta> squares_after_change;
};

/// Times, evenly on a logarithmic scale, from 0.1 to 99 s.
const std::vector<double>& plotted_s();

inline constexpr double wide_band = 0.05;
inline constexpr double narrow_band = 0.01;
inline constexpr double steady_s = 40.0;

/// Runs the trial to the end; empty when it was stopped.
std::optional<Outcome> run(const ContenderKind& kind, const Trial& trial, std::uint64_t seed,
                           const std::atomic<bool>& stop);

}  // namespace supercoil::host_sim::estimators
