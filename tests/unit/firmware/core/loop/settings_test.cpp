#include "loop/settings.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(BoardSettingsCheck) {
  BoardSettings settings;
  void check_says(const char* what, const char* key = "") const {
    const auto problem = check(settings);
    CHECK(problem.has_value());
    STRCMP_EQUAL(key, problem->key.c_str());
    STRCMP_CONTAINS(what, problem->message.c_str());
  }
};

TEST(BoardSettingsCheck, DefaultsMayRun) {
  CHECK_FALSE(check(settings).has_value());
}

TEST(BoardSettingsCheck, RefusesAnInvalidBoard) {
  settings.channels.clear();
  check_says("a board has 1 to 16 channels, not 0");
  settings.channels.resize(17);
  check_says("not 17");
  settings.channels.resize(16);
  CHECK_FALSE(check(settings).has_value());
  settings.channels[3].controllers.clear();
  check_says("needs a controller");
  settings.channels[3].controllers.resize(1);
  settings.channels[3].estimators.clear();
  check_says("and an estimator");
}

TEST(BoardSettingsCheck, RefusesAPumpThatALateTickWouldStop) {
  settings.supervision.overruns_in_a_row = 10;
  settings.supervision.charge_pump_decay_s = 0.0201;
  CHECK_FALSE(check(settings).has_value());
  settings.supervision.charge_pump_decay_s = 0.0199;
  check_says("10 in a row at 1000 Hz are 10 ms, so more than 20 ms, not 19.9",
             "charge_pump_decay_ms");
}

TEST(BoardSettingsCheck, TheLoopsDelayIsATickAndTheHeaters) {
  ChannelSettings channel;
  channel.heater.delay_s = 0.004;
  DOUBLES_EQUAL(0.005, loop_delay_s(channel, 0.001), 1e-15);
}
