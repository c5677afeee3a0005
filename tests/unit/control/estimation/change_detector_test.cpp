// Changes are distinguished from residuals that recur with the motion.
#include "supercoil/control/estimation/change_detector.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil::control;

namespace {

using Detector = ChangeDetector<2>;
constexpr double detector_period_s = 0.01;

Detector::Signals signals(double time_s) {
  return {std::sin(20.0 * time_s), 1.0};
}

/// The first change found before to_s, its time and direction, given the residual at each time.
struct Found {
  double time_s = -1.0;
  int direction = -1;
};
template <class Residual>
Found watch(Detector& detector, double to_s, Residual residual) {
  for (int k = 0; k < static_cast<int>(to_s / detector_period_s); ++k) {
    const double time_s = k * detector_period_s;
    const auto found = detector.step(signals(time_s), residual(time_s));
    if (found) return {time_s, *found};
  }
  return {};
}

Detector fresh() {
  return Detector({.period_s = detector_period_s, .floor_rms = 0.01});
}

/// The residual that an imperfect model leaves along both directions, again and again.
double of_model(double time_s) {
  return std::sin(1.5 * time_s) * (0.1 * signals(time_s)[0] + 0.07);
}

}  // namespace

TEST_GROUP(ChangeDetector){};

TEST(ChangeDetector, ARecurringModelErrorIsNotAChange) {
  Detector detector = fresh();
  DOUBLES_EQUAL(-1.0, watch(detector, 2000.0, of_model).time_s, 0.0);
}

TEST(ChangeDetector, AChangeAlongADirectionIsDetectedAndMeasured) {
  for (const int direction : {0, 1}) {
    Detector detector = fresh();
    const Found found = watch(detector, 300.0, [&](double time_s) {
      return of_model(time_s) + (time_s > 200.0 ? -0.9 * signals(time_s)[direction] : 0.0);
    });
    LONGS_EQUAL(direction, found.direction);
    CHECK(found.time_s > 200.0);
    CHECK(found.time_s < 201.0);
    for (int k = 0; k < 300; ++k) {
      const double t_s = found.time_s + k * detector_period_s;
      (void)detector.step(signals(t_s), of_model(t_s) - 0.9 * signals(t_s)[direction]);
    }
    DOUBLES_EQUAL(-0.9, detector.amount(direction), 0.1);
  }
}

TEST(ChangeDetector, IsBlindAtFirstAndDoesNotRepeatAChangeTooSoon) {
  Detector detector = fresh();
  const Found found =
      watch(detector, 300.0, [](double time_s) { return time_s > 50.0 ? 1.0 : 0.0; });
  DOUBLES_EQUAL(-1.0, found.time_s, 0.0);
  Detector later = fresh();
  int detections = 0;
  for (int k = 0; k < 10'300; ++k) {
    const double time_s = k * detector_period_s;
    if (later.step(signals(time_s), time_s > 100.0 ? 1.0 : 0.0)) ++detections;
  }
  LONGS_EQUAL(1, detections);
}
