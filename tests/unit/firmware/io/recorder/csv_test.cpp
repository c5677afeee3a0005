// A recording as CSV.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/recorder/support/rows.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

TEST_GROUP(Csv) {
  recorder::Recording recording;
  std::string text;

  recorder::Sink into() {
    return [this](std::string_view part) -> Result<void> {
      text += part;
      return {};
    };
  }
  std::vector<std::string> lines() {
    CHECK(to_csv(recording, into()).has_value());
    auto all = split(text, '\n');
    STRCMP_EQUAL("", all.back().c_str());
    all.pop_back();
    return all;
  }
};

TEST(Csv, HasEveryFieldUnderItsName) {
  recording.header.fault_time_ns = 5 * second_ns;
  Row r{};
  r.time_ns = 4'999'000'000;
  r.channel = 1;
  r.state = 2;
  r.mode = 1;
  r.fault = 30;
  r.limited_by = 4;
  r.controller = 3;
  r.flags = 1 + 4 + 8 + 32;
  r.margin_selector = 41;
  r.gain_selector = 2;
  r.result = 6;
  r.multiplexed_selector = 2;
  r.identify_notes = note_poor_fit | note_theta2_uncertain;
  float value = 0.5F;
  for (float* field : {&r.reference,        &r.model_m,
                       &r.position_m,       &r.demanded_W,
                       &r.applied_W,        &r.duty,
                       &r.supply_V,         &r.current_A,
                       &r.resistance_Ohm,   &r.resistance_age_s,
                       &r.coldest_C,        &r.hottest_C,
                       &r.theta[0],         &r.theta[1],
                       &r.theta[2],         &r.theta[3],
                       &r.error_bound,      &r.progress,
                       &r.margin_used,      &r.margin_measured,
                       &r.margin_limit,     &r.gain,
                       &r.multiplexed_value}) {
    *field = value;
    value += 1.0F;
  }
  recording.rows = {r};
  const auto all = lines();
  LONGS_EQUAL(2, all.size());
  STRCMP_EQUAL(
      "time_s,channel,state,mode,fault,limited_by,controller,probing,trusted,limited,reference,"
      "model_m,position_m,demanded_W,applied_W,duty,supply_V,current_A,resistance_Ohm,"
      "resistance_age_s,coldest_C,hottest_C,theta1,theta2,theta3,theta4,error_bound,progress,"
      "margin_selector,margin_used,margin_measured,margin_limit,gain_selector,gain,result,"
      "multiplexed_selector,multiplexed_value,"
      "identify_notes,proof_off,oscillated,slack",
      all[0].c_str());
  STRCMP_EQUAL(
      "-0.001,2,active,position,over_temperature,temperature,3,1,0,1,0.5,1.5,2.5,3.5,4.5,5.5,6.5,"
      "7.5,8.5,9.5,10.5,11.5,12.5,13.5,14.5,15.5,16.5,17.5,over_voltage,18.5,19.5,20.5,integral,21."
      "5,poor_fit,theta1_deviation,22.5,18,1,0,1",
      all[1].c_str());
}

TEST(Csv, NaNIsEmptyAndInfinityIsInf) {
  Row r{};
  r.reference = NAN;
  r.margin_limit = -NAN;
  r.margin_used = INFINITY;
  recording.rows = {r};
  const auto fields = split(lines()[1], ',');
  LONGS_EQUAL(41, fields.size());
  STRCMP_EQUAL("", fields[10].c_str());
  STRCMP_EQUAL("inf", fields[29].c_str());
  STRCMP_EQUAL("", fields[31].c_str());
}

TEST(Csv, UnnamedValuesAreShownAsNumbers) {
  Row r{};
  r.state = 9;
  r.mode = 200;
  r.fault = 99;
  r.limited_by = 8;
  recording.rows = {r};
  const auto fields = split(lines()[1], ',');
  STRCMP_EQUAL("9", fields[2].c_str());
  STRCMP_EQUAL("200", fields[3].c_str());
  STRCMP_EQUAL("99", fields[4].c_str());
  STRCMP_EQUAL("8", fields[5].c_str());
  STRCMP_EQUAL("none", fields[28].c_str());
}

TEST(Csv, EveryStateModeAndLimitHasItsName) {
  for (std::size_t i = 0; i < limit_names.size(); ++i) {
    Row r{};
    r.state = r.mode = r.limited_by = static_cast<std::uint8_t>(i);
    recording.rows.push_back(r);
  }
  const auto all = lines();
  const char* expected[] = {"disarmed,rest,none,nothing,",   "armed,position,none,minimum,",
                            "active,power,none,maximum,",    "fault,identify,none,slew,",
                            "4,calibrate,none,temperature,", "5,joint,none,invalid,",
                            "6,bundle,none,cooling,",        "7,7,none,unproven,"};
  for (std::size_t i = 0; i < limit_names.size(); ++i)
    STRCMP_CONTAINS(expected[i], all[i + 1].c_str());
}

TEST(Csv, NumbersRoundTrip) {
  for (const float value : {1.0F / 3.0F, 1e-30F, -3.4e38F, std::numeric_limits<float>::denorm_min(),
                            std::numeric_limits<float>::max(), -0.0F}) {
    Row r{};
    r.duty = value;
    recording.rows = {r};
    text.clear();
    const std::string field = split(lines()[1], ',')[15];
    CHECK(std::strtof(field.c_str(), nullptr) == value);
    CHECK(field.find('e') == std::string::npos);
  }
}

TEST(Csv, TimesAreExact) {
  recording.header.fault_time_ns = 123'456'789'012'345;
  recording.rows = {row(123'446'789'012'345, 0), row(123'456'789'012'346, 0)};
  const auto all = lines();
  STRCMP_EQUAL("-10", split(all[1], ',')[0].c_str());
  STRCMP_EQUAL("0.000000001", split(all[2], ',')[0].c_str());
}

TEST(Csv, OverflowingTimeDifferencesAreHarmless) {
  recording.header.fault_time_ns = std::numeric_limits<std::int64_t>::min();
  recording.rows = {row(std::numeric_limits<std::int64_t>::max(), 0)};
  LONGS_EQUAL(2, lines().size());
}

TEST(Csv, IsWrittenInPartsAndStopsAtTheFirstFailure) {
  for (int i = 0; i < 10'000; ++i)
    recording.rows.push_back(row(i * tick_ns, 0));
  LONGS_EQUAL(10'001, lines().size());
  int parts = 0;
  const auto written = to_csv(recording, [&](std::string_view) -> Result<void> {
    return ++parts == 2 ? Result<void>(failure("full")) : Result<void>();
  });
  STRCMP_EQUAL("full", written.error().text().c_str());
  LONGS_EQUAL(2, parts);
}
