#include "telemetry/run_settings.hpp"

#include <string>

#include <CppUTest/TestHarness.h>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"

using namespace supercoil;

TEST_GROUP(RunSettings){};

TEST(RunSettings, HaveTheNamesOfTheProtocol) {
  const can::MessageInfo& message = *can::find_message("Setting");
  const can::SignalInfo& setting = message.signals[can::signal_index(message, "setting")];
  for (std::uint8_t i = 0; i < telemetry::run_settings; ++i) {
    STRCMP_EQUAL(std::string(can::value_name(setting, i)).c_str(),
                 telemetry::run_setting_name(i).c_str());
  }
  STRCMP_EQUAL("max_power_W", telemetry::run_setting_name(0).c_str());
  STRCMP_EQUAL("supply_gain", telemetry::run_setting_name(telemetry::supply_gain).c_str());
}
