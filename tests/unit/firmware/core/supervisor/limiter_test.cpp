#include "supervisor/limiter.hpp"

#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using supercoil::test::tick_s;

namespace {

constexpr double cool_C = 30.0;

void check(Limiter::Result result, double power_W, LimitedBy by) {
  DOUBLES_EQUAL(power_W, result.power_W, 1e-9);
  LONGS_EQUAL(static_cast<int>(by), static_cast<int>(result.by));
}

}  // namespace

TEST_GROUP(Limiter){};

TEST(Limiter, ReportsThePowerAllowedForAHotMuscle) {
  Limiter limiter({}, tick_s);
  DOUBLES_EQUAL(4.5, limiter.max_W(20.0), 1e-12);
  DOUBLES_EQUAL(4.5, limiter.max_W(130.0), 1e-12);
  DOUBLES_EQUAL(2.25, limiter.max_W(145.0), 1e-12);
  DOUBLES_EQUAL(0.0, limiter.max_W(170.0), 0.0);
  DOUBLES_EQUAL(0.0, limiter.max_W(std::nan("")), 0.0);
  limiter.set_cap(1.0);
  DOUBLES_EQUAL(0.5, limiter.max_W(145.0), 1e-12);
}

TEST(Limiter, PassesAllowedPower) {
  Limiter limiter({}, tick_s);
  check(limiter.step(2.0, cool_C), 2.0, LimitedBy::nothing);
}

TEST(Limiter, ReportsTheActiveLimit) {
  Limiter limiter({}, tick_s);
  check(limiter.step(9.0, cool_C), 4.5, LimitedBy::maximum);
  check(limiter.step(-1.0, cool_C), 0.0, LimitedBy::minimum);
  check(limiter.step(4.0, 145.0), 2.25, LimitedBy::temperature);
  check(limiter.step(4.0, 160.0), 0.0, LimitedBy::temperature);
  check(limiter.step(4.0, 500.0), 0.0, LimitedBy::temperature);
}

TEST(Limiter, LimitsAnUnprovenMuscle) {
  Limiter limiter({}, tick_s);
  limiter.set_unproven(1.5);
  check(limiter.step(2.0, cool_C), 1.5, LimitedBy::unproven);
  check(limiter.step(1.4, cool_C), 1.4, LimitedBy::nothing);
}

TEST(Limiter, AppliesANewRange) {
  Limiter limiter({}, tick_s);
  limiter.set_range(0.2, 3.0);
  DOUBLES_EQUAL(0.2, limiter.min_W(), 0.0);
  check(limiter.step(0.1, cool_C), 0.2, LimitedBy::minimum);
  check(limiter.step(3.1, cool_C), 3.0, LimitedBy::maximum);
}

TEST(Limiter, LimitsTheSlewOfRisesButNotOfFalls) {
  LimiterSettings settings;
  settings.slew_W_per_s = 100.0;
  Limiter limiter(settings, tick_s);
  check(limiter.step(4.0, cool_C), 0.1, LimitedBy::slew);
  check(limiter.step(4.0, cool_C), 0.2, LimitedBy::slew);
  check(limiter.step(0.0, cool_C), 0.0, LimitedBy::nothing);
  limiter.step(4.0, cool_C);
  limiter.step(4.0, cool_C);
  limiter.reset();
  check(limiter.step(4.0, cool_C), 0.1, LimitedBy::slew);
}

TEST(Limiter, GivesNothingForNaN) {
  Limiter limiter({}, tick_s);
  check(limiter.step(std::nan(""), cool_C), 0.0, LimitedBy::invalid);
  check(limiter.step(INFINITY, cool_C), 0.0, LimitedBy::invalid);
  check(limiter.step(-INFINITY, cool_C), 0.0, LimitedBy::invalid);
  check(limiter.step(2.0, std::nan("")), 0.0, LimitedBy::invalid);
  check(limiter.step(-2.0, std::nan("")), 0.0, LimitedBy::invalid);
}

TEST(Limiter, NeverExceedsTheRequestOrTheLimits) {
  CHECK(rc::check("limits", [] {
    Limiter limiter({}, tick_s);
    for (int i = 0; i < 20; ++i) {
      const double wanted = *rc::gen::inRange(-10000, 10000) * 1e-3;
      const double temperature = *rc::gen::inRange(0, 200);
      const Limiter::Result result = limiter.step(wanted, temperature);
      RC_ASSERT(result.power_W >= 0.0 && result.power_W <= 4.5);
      RC_ASSERT(result.power_W <= std::fmax(wanted, 0.0));
      RC_ASSERT(temperature < 160 || result.power_W == 0.0);
      RC_ASSERT((result.by == LimitedBy::nothing) == (result.power_W == wanted));
    }
  }));
}

TEST(Limiter, EachLimitHasItsOwnName) {
  using enum LimitedBy;
  STRCMP_EQUAL("nothing", std::string(name(nothing)).c_str());
  STRCMP_EQUAL("minimum", std::string(name(minimum)).c_str());
  STRCMP_EQUAL("maximum", std::string(name(maximum)).c_str());
  STRCMP_EQUAL("slew", std::string(name(slew)).c_str());
  STRCMP_EQUAL("temperature", std::string(name(temperature)).c_str());
  STRCMP_EQUAL("invalid", std::string(name(invalid)).c_str());
  STRCMP_EQUAL("cooling", std::string(name(cooling)).c_str());
  STRCMP_EQUAL("unproven", std::string(name(unproven)).c_str());
}
