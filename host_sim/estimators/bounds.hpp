// The best that an unbiased estimator can do in a trial, in the terms of its outcome.
#pragma once

#include <vector>

#include "estimators/trial.hpp"

namespace supercoil::host_sim::estimators {

/// By the Cramér–Rao bound of θ1…θ4 and a constant bias of the power. Times: until twice the bound
/// fits into the band, from rest with the motion known, after the change with nothing known.
struct Bounds {
  control::Theta to_5_percent_s;
  control::Theta to_1_percent_s;
  control::Theta back_to_5_percent_s;
  control::Theta steady;  ///< of a window of bound_window_s that ends at the change, motion unknown
  /// At plotted_s.
  std::vector<control::Theta> from_rest;
  std::vector<control::Theta> after_change;
};

/// The trial must have noise.
Bounds bounds_of(const Trial& trial);

}  // namespace supercoil::host_sim::estimators
