#include "campaign/sampler.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

#include <boost/random/sobol.hpp>

namespace supercoil::host_sim::campaign {

namespace {

// The standard defines this generator's numbers; distributions differ from library to library.
using Generator = std::mt19937_64;

Generator generator(std::uint64_t seed, std::uint64_t stream, std::uint64_t number) {
  constexpr unsigned half = 32;
  std::seed_seq words{seed & 0xffffffffU, seed >> half, stream, number >> half,
                      number & 0xffffffffU};
  return Generator(words);
}

/// Between 0 and 1, both excluded.
double fraction(std::uint64_t bits) {
  constexpr unsigned unused = 12;
  return (static_cast<double>(bits >> unused) + 0.5) * 0x1p-52;
}

constexpr double below_1 = 1.0 - 0x1p-53;

enum Stream : std::uint64_t { shifts = 1, order = 2, points = 3 };

/// 0 to count − 1 in random order (Fisher and Yates).
std::vector<std::uint32_t> permutation(Generator from, std::size_t count) {
  std::vector<std::uint32_t> parts(count);
  std::iota(parts.begin(), parts.end(), 0U);
  for (std::size_t left = count; left > 1; --left) {
    const auto with = static_cast<std::size_t>(fraction(from()) * static_cast<double>(left));
    std::swap(parts[left - 1], parts[with]);
  }
  return parts;
}

}  // namespace

Sampler::Sampler(Sampling sampling, std::uint64_t seed, std::size_t dimensions, std::size_t runs)
    : sampling_(sampling), seed_(seed), dimensions_(dimensions) {
  for (std::size_t i = 0; i < dimensions; ++i) {
    if (sampling == Sampling::sobol) shift_.push_back(generator(seed, shifts, i)());
    if (sampling == Sampling::latin_hypercube)
      parts_.push_back(permutation(generator(seed, order, i), runs));
  }
}

std::vector<double> Sampler::point(std::size_t run) const {
  if (dimensions_ == 0) return {};
  if (sampling_ == Sampling::sobol) return sobol(run);
  std::vector<double> point = random(run);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto part = static_cast<double>(parts_[i][run]);
    // The last part's end may round to 1.
    point[i] = std::min((part + point[i]) / static_cast<double>(parts_[i].size()), below_1);
  }
  return point;
}

std::vector<double> Sampler::sobol(std::size_t run) const {
  // Boost's sequence begins with the second point. With the first, of zeros, each power of two of
  // runs is spread evenly.
  boost::random::sobol sequence(dimensions_);
  if (run > 0) sequence.discard(static_cast<std::uint64_t>(run - 1) * dimensions_);
  std::vector<double> point;
  for (const std::uint64_t shift : shift_)
    point.push_back(fraction((run > 0 ? sequence() : 0U) ^ shift));
  return point;
}

std::vector<double> Sampler::random(std::size_t run) const {
  Generator from = generator(seed_, points, run);
  std::vector<double> point;
  for (std::size_t i = 0; i < dimensions_; ++i)
    point.push_back(fraction(from()));
  return point;
}

}  // namespace supercoil::host_sim::campaign
