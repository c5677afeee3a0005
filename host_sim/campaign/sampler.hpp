// Points of the unit cube, one for each run of a study.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "supercoil/control/scalar/arithmetic.hpp"

namespace supercoil::host_sim::campaign {

enum class Sampling { sobol, latin_hypercube, random };
inline constexpr control::Names<Sampling, 3> sampling_names{
    {{"sobol", Sampling::sobol},
     {"latin_hypercube", Sampling::latin_hypercube},
     {"random", Sampling::random}}};

/// The same arguments give the same points, on every machine and in any order.
class Sampler {
 public:
  /// dimensions: at most 3667 for a Sobol sequence. runs: for a Latin hypercube, which has one
  /// point in each of this many equal parts of each dimension; the other kinds do not depend on it.
  Sampler(Sampling sampling, std::uint64_t seed, std::size_t dimensions, std::size_t runs);

  /// Coordinates between 0 and 1, both excluded. run: from 0, below runs.
  std::vector<double> point(std::size_t run) const;

 private:
  std::vector<double> sobol(std::size_t run) const;
  std::vector<double> random(std::size_t run) const;

  Sampling sampling_;
  std::uint64_t seed_;
  std::size_t dimensions_;
  /// A Sobol sequence's random shift of each dimension; without it, all seeds would give the same.
  std::vector<std::uint64_t> shift_;
  /// A Latin hypercube's part of each run, dimension by dimension.
  std::vector<std::vector<std::uint32_t>> parts_;
};

}  // namespace supercoil::host_sim::campaign
