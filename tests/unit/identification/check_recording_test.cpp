// What is refused before anything is fitted, and how rows become samples.
#include <cmath>
#include <limits>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/identification/recording.hpp"

namespace {

using supercoil::identification::check;
using supercoil::identification::cut;
using supercoil::identification::Gaps;
using supercoil::identification::Recording;
using supercoil::identification::resample;
using supercoil::identification::Samples;

/// 200 valid rows of 10 ms, in lines 2 to 201.
Recording good_recording() {
  Recording r;
  for (std::size_t i = 0; i < 200; ++i) {
    r.time_s.push_back(0.01 * static_cast<double>(i));
    r.position_m.push_back(1e-5 * static_cast<double>(i));
    r.power_W.push_back(i < 100 ? 0.0 : 2.0);
    r.line.push_back(i + 2);
  }
  return r;
}

void check_refused(Recording r, std::size_t line, const std::string& part,
                   Gaps gaps = Gaps::refuse) {
  const auto checked = check(r, gaps);
  CHECK_TEXT(!checked, "it was accepted");
  if (checked) return;
  UNSIGNED_LONGS_EQUAL(line, checked.error().line);
  STRCMP_CONTAINS(part.c_str(), checked.error().text.c_str());
}

}  // namespace

TEST_GROUP(CheckRecording){};

TEST(CheckRecording, AcceptsAGoodRecordingWithoutWarnings) {
  Recording r = good_recording();
  CHECK(check(r, Gaps::refuse).has_value());
  CHECK(r.warnings.empty());
}

TEST(CheckRecording, RefusesTimesThatGoBackOrRepeat) {
  Recording r = good_recording();
  r.time_s[50] = 0.3;
  check_refused(r, 52, "the time goes back, from 0.49 to 0.3 s");
  r.time_s[50] = r.time_s[49];
  check_refused(r, 52, "occurs twice, first in line 51");
}

TEST(CheckRecording, RefusesAGapUnlessItIsBridged) {
  Recording r = good_recording();
  for (std::size_t i = 120; i < r.size(); ++i)
    r.time_s[i] += 1.5;
  check_refused(r, 122, "rows are missing: 1.51 s since the row before, 0.01 s elsewhere");
  CHECK(check(r, Gaps::bridge).has_value());
  UNSIGNED_LONGS_EQUAL(1, r.warnings.size());
  UNSIGNED_LONGS_EQUAL(122, r.warnings[0].line);
}

TEST(CheckRecording, WarnsOfASmallGap) {
  Recording r = good_recording();
  for (std::size_t i = 120; i < r.size(); ++i)
    r.time_s[i] += 0.05;
  CHECK(check(r, Gaps::refuse).has_value());
  UNSIGNED_LONGS_EQUAL(1, r.warnings.size());
  STRCMP_CONTAINS("rows are missing in 1 places", r.warnings[0].text.c_str());
}

TEST(CheckRecording, RefusesWrongUnits) {
  Recording r = good_recording();
  for (double& position : r.position_m)
    position *= 1e3;
  check_refused(r, 201,
                "position moves by 1.99 m, with its highest value here: is it in another unit");
  r = good_recording();
  for (double& position : r.position_m)
    position *= 1e-4;
  check_refused(r, 201, "--position-unit");
  r = good_recording();
  for (double& time : r.time_s)
    time *= 1e3;
  check_refused(r, 3, "rows are 10 s apart: is time in another unit (--time-unit)?");
  r = good_recording();
  for (double& power : r.power_W)
    power *= 1e3;
  check_refused(r, 102, "power reaches 2000 W here: is it in another unit (--power-unit)?");
}

TEST(CheckRecording, RefusesUninformativeRecordings) {
  Recording r = good_recording();
  r.power_W.assign(r.size(), 2.0);
  check_refused(r, 2, "power never changes from 2 W");
  r = good_recording();
  r.position_m.assign(r.size(), 0.001);
  check_refused(r, 2, "position never changes");
  r = good_recording();
  cut(r, {0.0, 0.3});
  check_refused(r, 0, "has 31 rows; a fit needs 50");
}

TEST(CheckRecording, RefusesImpossibleValues) {
  Recording r = good_recording();
  r.power_W[70] = -0.1;
  check_refused(r, 72, "power is -0.1 W");
  r = good_recording();
  r.position_m[70] = std::numeric_limits<double>::infinity();
  check_refused(r, 72, "infinite");
}

TEST(CheckRecording, OmitsMissingPositions) {
  Recording r = good_recording();
  for (std::size_t i = 30; i < 60; ++i)
    r.position_m[i] = NAN;
  CHECK(check(r, Gaps::refuse).has_value());
  UNSIGNED_LONGS_EQUAL(32, r.warnings[0].line);
  STRCMP_CONTAINS("position is missing in 30 of 200 rows", r.warnings[0].text.c_str());
  const Samples samples = resample(r);
  CHECK(!samples.measured(20));
  CHECK(samples.measured(14) && samples.measured(30));
  for (std::size_t i = 30; i < 160; ++i)
    r.position_m[i] = NAN;
  check_refused(r, 32, "position is missing in 130 of 200 rows");
}

TEST_GROUP(Resample){};

TEST(Resample, AveragesPositionAroundASampleAndPowerAfterIt) {
  const Samples samples = resample(good_recording());
  DOUBLES_EQUAL(0.02, samples.step_s, 1e-12);
  UNSIGNED_LONGS_EQUAL(100, samples.size());
  DOUBLES_EQUAL(5e-4, samples.position_m[25], 1e-12);
  DOUBLES_EQUAL(0.0, samples.power_W[49], 1e-12);
  DOUBLES_EQUAL(2.0, samples.power_W[50], 1e-12);
}

TEST(Resample, AveragingLeavesOscillationsAsTheyAre) {
  Recording r;
  for (const double interval_s : {0.001, 0.01}) {
    r = {};
    for (std::size_t i = 0; i < 1000; ++i) {
      r.time_s.push_back(interval_s * static_cast<double>(i));
      r.position_m.push_back(0.001 * std::sin(30.0 * r.time_s.back()));
      r.power_W.push_back(0.0);
      r.line.push_back(i + 2);
    }
    const Samples samples = resample(r);
    DOUBLES_EQUAL(0.02, samples.step_s, 1e-12);
    // The means alone are 1.5 to 3 % smaller.
    for (std::size_t k = 1; k + 1 < samples.size(); ++k)
      DOUBLES_EQUAL(0.001 * std::sin(30.0 * samples.time_s(k)), samples.position_m[k], 3e-6);
  }
}

TEST(Resample, PreservesEnergyAtAnOddRate) {
  Recording r = good_recording();
  for (std::size_t i = 0; i < r.size(); ++i)
    r.time_s[i] = 0.013 * static_cast<double>(i) + (i % 2 == 0 ? 0.0 : 0.004);
  CHECK(check(r, Gaps::refuse).has_value());
  const Samples samples = resample(r);
  double energy_J = 0.0;
  for (const double power_W : samples.power_W)
    energy_J += power_W * samples.step_s;
  DOUBLES_EQUAL(2.0 * (samples.end_s() + samples.step_s - r.time_s[100]), energy_J, 1e-9);
  // The position is linear except for the jitter of 4 ms and half an averaging interval.
  DOUBLES_EQUAL(1e-5 * samples.time_s(80) / 0.013, samples.position_m[80], 8e-6);
}
