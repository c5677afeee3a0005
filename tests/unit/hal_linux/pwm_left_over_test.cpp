// A PWM output is brought to rest without a refused write, whatever state it was left in.
#include <cstdint>
#include <ostream>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "supercoil/hal_linux/sysfs_pwm.hpp"

#include "unit/hal_linux/support/pwm_kernel.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

rc::Gen<std::int64_t> nanoseconds() {
  // A few values are frequent, so that equal and neighbouring ones meet.
  return rc::gen::oneOf(rc::gen::element<std::int64_t>(0, 1, 99'999, 100'000, 100'001, 1'000'000),
                        rc::gen::inRange<std::int64_t>(0, 2'000'000'000));
}

PwmState left_over() {
  return {*nanoseconds(), *nanoseconds(), *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>()};
}

std::string all(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines)
    text += line + "; ";
  return text;
}

}  // namespace

TEST_GROUP(PwmLeftOver){};

TEST(PwmLeftOver, OfAnyKindIsStoppedWithoutARefusedWrite) {
  CHECK(rc::check("from any state", [] {
    const PwmState left = left_over();
    const auto rules = *rc::gen::element(Rules::strict, Rules::since_6_8, Rules::enabled_only);
    const auto period_ns = *rc::gen::element<std::int64_t>(5000, 100'000, 1'000'000, 1'000'000'000);
    PwmKernel kernel(left, true, rules);
    const auto pwm = SysfsPwm::open({"pca9685", 5, period_ns, 4095, kernel.root()});
    if (!pwm) RC_FAIL(pwm.error().text());
    RC_ASSERT(all(kernel.refusals).empty());
    RC_ASSERT(kernel.state == (PwmState{period_ns, 0, true, false}));
  }));
}

TEST(PwmLeftOver, NeverHeatsMoreThanBefore) {
  CHECK(rc::check("on-time", [] {
    PwmState left = left_over();
    RC_PRE(left.period_ns > 0 && left.duty_ns <= left.period_ns);
    PwmKernel kernel(left);
    const auto pwm = SysfsPwm::open({"pca9685", 5, 100'000, 4095, kernel.root()});
    RC_ASSERT(pwm.has_value());
    // While the period changes the duty is 0; an inversed output is disabled first.
    RC_ASSERT(kernel.max_on <= left.on());
  }));
}

/// A longer period would turn the output on.
TEST(PwmLeftOver, ThatIsInvertedAndOffStaysOff) {
  PwmKernel kernel({50'000, 50'000, true, true});
  CHECK(SysfsPwm::open({"pca9685", 5, 100'000, 4095, kernel.root()}).has_value());
  DOUBLES_EQUAL(0.0, kernel.max_on, 0.0);
}

TEST(PwmLeftOver, EveryStepIsAcceptedAndReadsBack) {
  CHECK(rc::check("steps", [] {
    const int steps = *rc::gen::element(1, 2, 100, 4095, 5000);
    const auto period_ns = *rc::gen::element<std::int64_t>(5000, 100'001, 1'000'000, 999'999'937);
    PwmKernel kernel;
    const auto pwm = SysfsPwm::open({"pca9685", 5, period_ns, steps, kernel.root()});
    RC_ASSERT(pwm.has_value());
    for (int i = 0; i < 20; ++i) {
      const int step = *rc::gen::inRange(0, steps + 1);
      RC_ASSERT((*pwm)->set(step) == hal::Status::ok);
      RC_ASSERT((*pwm)->read_back() == step);
    }
  }));
}
