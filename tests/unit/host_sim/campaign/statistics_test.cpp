// Rates, their confidence intervals, and the quantities that decide.
#include "campaign/statistics.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil::host_sim::campaign;

TEST_GROUP(CampaignStatistics){};

// R: binom.test(5, 100)$conf.int, and so on.
TEST(CampaignStatistics, IntervalIsExact) {
  const Rate some = rate_of(5, 100);
  DOUBLES_EQUAL(0.05, some.rate(), 1e-15);
  DOUBLES_EQUAL(0.01643188, some.low, 1e-8);
  DOUBLES_EQUAL(0.11283491, some.high, 1e-8);
  const Rate none = rate_of(0, 10);
  DOUBLES_EQUAL(0.0, none.low, 0.0);
  DOUBLES_EQUAL(0.30849711, none.high, 1e-8);
  const Rate all = rate_of(10, 10);
  DOUBLES_EQUAL(0.69150289, all.low, 1e-8);
  DOUBLES_EQUAL(1.0, all.high, 0.0);
  const Rate nothing = rate_of(0, 0);
  DOUBLES_EQUAL(0.0, nothing.low, 0.0);
  DOUBLES_EQUAL(1.0, nothing.high, 0.0);
}

TEST(CampaignStatistics, QuantileIsOneOfTheValues) {
  DOUBLES_EQUAL(3.0, quantile({5.0, 1.0, 3.0, 2.0, 4.0}, 0.5), 0.0);
  DOUBLES_EQUAL(5.0, quantile({5.0, 1.0, 3.0, 2.0, 4.0}, 0.95), 0.0);
  DOUBLES_EQUAL(1.0, quantile({1.0}, 0.01), 0.0);
  CHECK(std::isinf(quantile({1.0, INFINITY}, 1.0)));
  CHECK(std::isnan(quantile({}, 0.5)));
}

TEST(CampaignStatistics, RankCorrelationDependsOnlyOnOrder) {
  DOUBLES_EQUAL(1.0, rank_correlation({1.0, 2.0, 3.0, 4.0}, {1.0, 10.0, 1e3, INFINITY}), 1e-15);
  DOUBLES_EQUAL(-1.0, rank_correlation({1.0, 2.0, 3.0}, {9.0, 4.0, 1.0}), 1e-15);
  // scipy.stats.spearmanr([1, 2, 2, 4, 5], [3, 1, 2, 2, 5])
  DOUBLES_EQUAL(0.2894736842105264,
                rank_correlation({1.0, 2.0, 2.0, 4.0, 5.0}, {3.0, 1.0, 2.0, 2.0, 5.0}), 1e-12);
  CHECK(std::isnan(rank_correlation({1.0, 1.0, 1.0}, {1.0, 2.0, 3.0})));
}
