// A NaN from any source makes the channel cold.
#include <cmath>
#include <limits>
#include <string>

#include <CppUTest/TestHarness.h>

#include "loop/support/situations.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

const double cap_W = LimiterSettings{}.max_W;

void check_cools(Rig& rig, Fault expected) {
  CHECK(rig.run_until([&] { return rig.state() == State::fault; }, 5.0));
  if (rig.fault() != expected) FAIL(std::string(name(rig.fault())).c_str());
  rig.run(0.002);
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
  }
}

}  // namespace

TEST_GROUP(NotANumber){};

TEST(NotANumber, FromAControllerIsAFault) {
  for (const double gain : {std::nan(""), std::numeric_limits<double>::max()}) {
    RigSettings settings = rough_board();
    settings.firmware.channels[0].controllers[0].pi.proportional_W_per_m = gain;
    settings.firmware.channels[0].controllers[0].dc_gain_m_per_W = 1e3;
    Rig rig(settings);
    rig.boot();
    rig.arm();
    rig.run(0.2);
    rig.heat(Task::position);
    // The limiter has seen it before any detector does.
    if (std::isnan(gain)) CHECK(rig.snapshot().limited_by == LimitedBy::invalid);
    CHECK(std::isfinite(rig.snapshot().applied_W));
    CHECK_COMPARE(rig.snapshot().applied_W, <=, cap_W);
    check_cools(rig, Fault::controller_invalid);
  }
}

TEST(NotANumber, FromAScalingIsAFault) {
  struct Spoilt {
    void (*spoil)(RigSettings&);
    Fault expected;
  };
  for (const Spoilt& spoilt : {
           Spoilt{[](RigSettings& s) {
                    s.firmware.channels[0].position.scaling.per_count = std::nan("");
                  },
                  Fault::sensor_out_of_range},
           Spoilt{[](RigSettings& s) { s.firmware.supply.scaling.offset = std::nan(""); },
                  Fault::under_voltage},
           Spoilt{[](RigSettings& s) {
                    s.firmware.channels[0].heater.current.scaling.per_count = std::nan("");
                  },
                  Fault::heater_stuck_on},
       }) {
    RigSettings settings = rough_board();
    spoilt.spoil(settings);
    Rig rig(settings);
    rig.run(1.0);
    if (rig.fault() != spoilt.expected) FAIL(std::string(name(rig.fault())).c_str());
    rig.arm();
    rig.run(1.0);
    CHECK(rig.state() == State::fault);
    DOUBLES_EQUAL(0.0, rig.muscle().true_power_W(), 0.0);
  }
}

TEST(NotANumber, FromAnEstimatorDoesNotReachTheHeater) {
  RigSettings settings = rough_board();
  settings.firmware.channels[0].estimators[0].gradient.gain *= 1e9;
  settings.firmware.channels[0].estimators[0].gradient.bounds.reset();
  Rig rig(settings);
  bring_to(Situation::pi, rig);
  rig.run(10.0);
  CHECK(rig.state() == State::active);
  CHECK_FALSE(rig.snapshot().trusted);
  CHECK_FALSE(rig.interval_missed);
  CHECK(std::isfinite(rig.snapshot().applied_W));
}
