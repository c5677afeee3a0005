#include "apps/supercoil/doctor/report.hpp"

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

using namespace supercoil;
using hal::Severity;

TEST_GROUP(DoctorReport) {
  const doctor::Report report{"rig",
                              "board.toml",
                              {{"kernel", Severity::ok, "6.1", ""},
                               {"light", Severity::problem, "no line '\xff\"'", "name it"},
                               {"watchdog", Severity::warning, "none", "use one"}}};
};

TEST(DoctorReport, HasATextForm) {
  STRCMP_EQUAL("ok       kernel                    6.1\n",
               doctor::to_text(report.findings[0]).c_str());
  STRCMP_EQUAL(
      "warning  watchdog                  none\n"
      "         what to do: use one\n",
      doctor::to_text(report.findings[2]).c_str());
  STRCMP_EQUAL("1 problem, 1 warning, 1 in order", doctor::summary(report).c_str());
  STRCMP_EQUAL("0 problems, 0 warnings, 0 in order", doctor::summary({}).c_str());
}

TEST(DoctorReport, HasAJsonForm) {
  const auto json = nlohmann::json::parse(doctor::to_json(report));
  STRCMP_EQUAL("rig", json["board"].get<std::string>().c_str());
  STRCMP_EQUAL("board.toml", json["config"].get<std::string>().c_str());
  LONGS_EQUAL(1, json["problems"].get<int>());
  LONGS_EQUAL(1, json["warnings"].get<int>());
  LONGS_EQUAL(3, json["findings"].size());
  const auto& second = json["findings"][1];
  STRCMP_EQUAL("light", second["what"].get<std::string>().c_str());
  STRCMP_EQUAL("problem", second["severity"].get<std::string>().c_str());
  STRCMP_EQUAL("name it", second["remedy"].get<std::string>().c_str());
  // A byte that is not text does not make the report unreadable.
  STRCMP_EQUAL("no line '\xef\xbf\xbd\"'", second["found"].get<std::string>().c_str());
}
