#include "apps/supercoil/setup/record.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil::operating;

TEST_GROUP(SetupRecord) {
  supercoil::test::TemporaryFolder folder;
  std::string config = folder.path() + "/board.toml";

  SetupRecord opened(int channel = 1) const {
    auto record = SetupRecord::open(config, channel);
    CHECK_TRUE_TEXT(record.has_value(), record ? "" : record.error().text().c_str());
    return *record;
  }
};

TEST(SetupRecord, ContinuesWhereAnEarlierRunEnded) {
  CHECK_FALSE(opened().has("describe"));
  CHECK_TRUE(opened().add("describe", {{"muscle", 1}}).has_value());
  CHECK_TRUE(opened().add("calibrate", {{"cold_resistance_Ohm", 9.5}}).has_value());
  CHECK_TRUE(opened().has("describe"));
  CHECK_TRUE(opened().has("calibrate"));
  CHECK_FALSE(opened().has("identify"));
  CHECK_FALSE(opened(2).has("describe"));
}

TEST(SetupRecord, RepeatingAStepInvalidatesLaterSteps) {
  for (const char* step : {"describe", "calibrate", "identify", "move"})
    CHECK_TRUE(opened().add(step, {{"done", true}}).has_value());
  CHECK_TRUE(opened(2).add("move", {{"done", true}}).has_value());
  CHECK_TRUE(opened().add("calibrate", {{"done", true}}).has_value());
  CHECK_TRUE(opened().has("describe"));
  CHECK_TRUE(opened().has("calibrate"));
  CHECK_FALSE(opened().has("identify"));
  CHECK_FALSE(opened().has("move"));
  CHECK_TRUE(opened(2).has("move"));
}

TEST(SetupRecord, DoctorDoesNotImplyADescribedMuscle) {
  CHECK_TRUE(opened().add("doctor", {{"problems", 0}}).has_value());
  CHECK_TRUE(opened().has("doctor"));
  CHECK_FALSE(opened().has_later_step("describe"));
  CHECK_TRUE(opened().add("senses", {{"done", true}}).has_value());
  CHECK_TRUE(opened().has_later_step("describe"));
  CHECK_TRUE(opened().has_later_step("doctor"));
}

TEST(SetupRecord, ADamagedRecordIsRefusedAndKept) {
  for (const char* damaged : {"{\"channel-1\": {", "[]", "{\"channel-1\": 3}"}) {
    std::ofstream(SetupRecord::path_of(config)) << damaged;
    const auto record = SetupRecord::open(config, 1);
    CHECK_FALSE(record.has_value());
    STRCMP_CONTAINS("board.toml.setup.json: is damaged", record.error().text().c_str());
    std::ifstream file(SetupRecord::path_of(config));
    const std::string kept{std::istreambuf_iterator<char>(file), {}};
    STRCMP_EQUAL(damaged, kept.c_str());
  }
}

TEST(SetupRecord, ReportsThePathThatCannotBeWritten) {
  config = folder.path() + "/missing/board.toml";
  const auto added = opened().add("describe", {{"muscle", 1}});
  CHECK_FALSE(added.has_value());
  STRCMP_CONTAINS("missing/board.toml.setup.json", added.error().text().c_str());
}
