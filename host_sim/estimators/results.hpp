// All outcomes of a comparison of estimators, and how they are reported.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "estimators/bounds.hpp"
#include "estimators/outcome.hpp"
#include "plot/figure.hpp"

namespace supercoil::host_sim::estimators {

/// Which run: indices into trials and contenders, and the seed.
struct Key {
  std::size_t trial;
  std::size_t contender;
  std::uint64_t seed;
  friend auto operator<=>(const Key&, const Key&) = default;  // NOLINT(modernize-use-nullptr)
};

using Outcomes = std::map<Key, Outcome>;
/// Of each trial; empty without noise, where accuracy has no bound.
using AllBounds = std::array<std::optional<Bounds>, trials.size()>;
/// ns per step of each contender.
using Costs = std::array<double, contender_count>;

/// trial,estimator,seed,measure,theta1,theta2,theta3,theta4, errors in %;
/// seed 0: the bound. Equal outcomes give equal bytes.
std::string to_csv(const Outcomes& outcomes, const AllBounds& bounds);

/// Markdown: one table per measure, mean over the seeds (worst).
std::string to_markdown(const Outcomes& outcomes, const AllBounds& bounds, const Costs& costs);

/// Errors in the nominal trial, rms over the seeds, from rest and after the change; the bound
/// dashed.
Figure figure_of(const Outcomes& outcomes, const AllBounds& bounds);

/// Measured here and now: the fastest of some thousands of steps.
Costs measure_costs();

}  // namespace supercoil::host_sim::estimators
