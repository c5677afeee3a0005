// What the runs of a study draw from: distributions, and points of the unit cube.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "campaign/distribution.hpp"
#include "campaign/sampler.hpp"

using namespace supercoil::host_sim::campaign;

namespace {

using Kind = Distribution::Kind;

/// Which of `parts` equal intervals the runs' points fall into.
std::set<int> intervals_hit(const Sampler& sampler, std::size_t dimension, int parts) {
  std::set<int> reached;
  for (std::size_t run = 0; run < static_cast<std::size_t>(parts); ++run)
    reached.insert(static_cast<int>(sampler.point(run)[dimension] * parts));
  return reached;
}

}  // namespace

TEST_GROUP(Distribution){};

TEST(Distribution, GivesItsQuantiles) {
  DOUBLES_EQUAL(2.5, (Distribution{Kind::uniform, 2.0, 4.0}.at(0.25)), 1e-15);
  DOUBLES_EQUAL(4.0, (Distribution{Kind::log_uniform, 1.0, 16.0}.at(0.5)), 1e-12);
  DOUBLES_EQUAL(7.0, (Distribution{Kind::constant, 7.0}.at(0.9)), 0.0);
  // scipy.stats.norm.ppf(0.975, 10, 2)
  DOUBLES_EQUAL(13.919927969080108, (Distribution{Kind::normal, 10.0, 2.0}.at(0.975)), 1e-12);
}

TEST(Distribution, TruncatedNormalStaysWithinItsLimitsAndKeepsItsShape) {
  const Distribution cut{Kind::normal, 0.0, 1.0, -1.0, 2.0};
  // scipy.stats.truncnorm.ppf([0.1, 0.5, 0.9], -1, 2)
  DOUBLES_EQUAL(-0.70464782, cut.at(0.1), 1e-8);
  DOUBLES_EQUAL(0.17116392, cut.at(0.5), 1e-8);
  DOUBLES_EQUAL(1.25571536, cut.at(0.9), 1e-8);
  CHECK(cut.at(1e-12) >= -1.0);
  CHECK(cut.at(1.0 - 1e-12) <= 2.0);
  // scipy.stats.truncnorm.ppf([0.1, 0.5, 0.9], 10, 11)
  const Distribution tail{Kind::normal, 0.0, 1.0, 10.0, 11.0};
  DOUBLES_EQUAL(10.01042809, tail.at(0.1), 1e-8);
  DOUBLES_EQUAL(10.06840937, tail.at(0.5), 1e-8);
  DOUBLES_EQUAL(10.22550495, tail.at(0.9), 1e-8);
  const Distribution far_out{Kind::normal, 0.0, 1.0, 50.0, 51.0};
  CHECK(far_out.at(0.5) >= 50.0 && far_out.at(0.5) <= 51.0);
}

TEST(Distribution, LogUniformMaySpanAllDecades) {
  DOUBLES_EQUAL(1.0, (Distribution{Kind::log_uniform, 1e-300, 1e300}.at(0.5)), 1e-9);
  CHECK(std::isfinite(Distribution{Kind::log_uniform, 1e-300, 1e300}.at(1.0)));
}

TEST(Distribution, ListValuesAreEquallyLikely) {
  Distribution list{Kind::list};
  list.values = 3;
  DOUBLES_EQUAL(0.0, list.at(0.333), 0.0);
  DOUBLES_EQUAL(1.0, list.at(0.334), 0.0);
  DOUBLES_EQUAL(2.0, list.at(1.0 - 1e-16), 0.0);
  DOUBLES_EQUAL(2.0, list.at(1.0), 0.0);  // as rounding may give for a correlated draw
}

TEST_GROUP(Sampler){};

TEST(Sampler, PointsAreInsideTheCube) {
  for (const auto& [name, sampling] : sampling_names) {
    const Sampler sampler(sampling, 3, 5, 200);
    for (std::size_t run = 0; run < 200; ++run) {
      for (const double x : sampler.point(run))
        CHECK_TEXT(x > 0.0 && x < 1.0, name.data());
    }
  }
}

TEST(Sampler, LatinHypercubeHitsEachIntervalOfEachDimensionOnce) {
  const Sampler sampler(Sampling::latin_hypercube, 1, 4, 100);
  for (std::size_t dimension = 0; dimension < 4; ++dimension)
    LONGS_EQUAL(100, intervals_hit(sampler, dimension, 100).size());
}

TEST(Sampler, SobolHitsEachIntervalOfEachDimensionOnceInPowersOfTwo) {
  const Sampler sampler(Sampling::sobol, 1, 6, 1);
  for (std::size_t dimension = 0; dimension < 6; ++dimension)
    LONGS_EQUAL(64, intervals_hit(sampler, dimension, 64).size());
}

TEST(Sampler, SobolFillsThePlaneOfTheFirstTwoDimensions) {
  const Sampler sampler(Sampling::sobol, 1, 2, 1);
  std::set<int> squares;
  for (std::size_t run = 0; run < 64; ++run) {
    const auto point = sampler.point(run);
    squares.insert(8 * static_cast<int>(8.0 * point[0]) + static_cast<int>(8.0 * point[1]));
  }
  LONGS_EQUAL(64, squares.size());
}

TEST(Sampler, OneSeedRepeatsItsPointsAndAnotherDiffers) {
  for (const auto& [name, sampling] : sampling_names) {
    const Sampler one(sampling, 1, 3, 50);
    const Sampler again(sampling, 1, 3, 50);
    const Sampler other(sampling, 2, 3, 50);
    for (std::size_t run : {7U, 49U, 0U}) {
      CHECK_TEXT(one.point(run) == again.point(run), name.data());
      CHECK_TEXT(one.point(run) != other.point(run), name.data());
    }
    CHECK_TEXT(one.point(1) != one.point(2), name.data());
  }
}

// A campaign can be continued on another machine, and its parts can be merged.
TEST(Sampler, PointsAreTheSameOnEveryMachine) {
  DOUBLES_EQUAL(0.67377268775118748, Sampler(Sampling::random, 1, 2, 1).point(0)[0], 0.0);
  DOUBLES_EQUAL(0.76004956538987722, Sampler(Sampling::sobol, 1, 2, 1).point(5)[1], 0.0);
  DOUBLES_EQUAL(0.47510405245576087, Sampler(Sampling::latin_hypercube, 1, 2, 10).point(5)[1], 0.0);
}
