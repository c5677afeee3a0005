// A detector that has not judged anything yet has used none of its limit.
#include <CppUTest/TestHarness.h>

#include "supervisor/detectors/heater.hpp"
#include "supervisor/detectors/liveness.hpp"
#include "supervisor/detectors/muscle.hpp"
#include "supervisor/detectors/sensor.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil::detectors;
using supercoil::test::tick_s;

namespace {

void check_fresh(const Detector& detector) {
  DOUBLES_EQUAL(0.0, detector.margin().measured, 0.0);
  DOUBLES_EQUAL(0.0, detector.margin().used(), 0.0);
}

}  // namespace

TEST_GROUP(FreshDetectors){};

TEST(FreshDetectors, HaveUsedNoMargin) {
  check_fresh(Limit(160.0));
  check_fresh(Flag());
  check_fresh(Above({5.9, 0.1}, tick_s));
  check_fresh(TimedFlag(0.1, tick_s));
  check_fresh(ConsecutiveCount(10));
  check_fresh(StalledCounter(0.5, tick_s));
  check_fresh(CommandTimeout(0.25, tick_s));
  check_fresh(ControllerSaturated(120.0, tick_s));
  check_fresh(Frozen({1e-6, 1.0}, tick_s));
  check_fresh(SensorsDisagree({30.0, 2.0}, tick_s));
  check_fresh(EnergyBudget({297.0, 60.0}, tick_s));
  check_fresh(WrongDuty(0.005, tick_s));
  check_fresh(ResistanceDrift({0.3, 0.5}, tick_s));
  check_fresh(Jump({0.5, 1e-4}));
  check_fresh(OpenLoad({0.02, 1.0, 0.02}, tick_s));
  check_fresh(StuckOn({0.05, 0.05}, tick_s));
  check_fresh(NotResponding({20.0, 0.3, 0.001}, tick_s));
}

TEST(FreshDetectors, HaveNothingToJudge) {
  CHECK_FALSE(OpenLoad({0.02, 1.0, 0.02}, tick_s).margin().judged);
  CHECK_FALSE(StuckOn({0.05, 0.05}, tick_s).margin().judged);
}
