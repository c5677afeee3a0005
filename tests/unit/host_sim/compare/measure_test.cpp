#include "compare/measure.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "compare/statistics.hpp"

using namespace supercoil::host_sim;
using namespace supercoil::host_sim::compare;

namespace {

Scenario scenario_of(double duration_s, double event_s = -1.0) {
  Scenario scenario;
  scenario.duration_s = duration_s;
  scenario.rate_Hz = 100.0;
  if (event_s >= 0.0) scenario.events.push_back({event_s, {}, false, false, false});
  return scenario;
}

/// The measures of a run whose error at time t is error_m(t).
template <class Error>
Values measured(const Scenario& scenario, Error error_m, double lost_from_s = INFINITY) {
  Meters meters(scenario);
  for (long k = 0; k < scenario.ticks(); ++k) {
    TickRecord record;
    record.time_s = static_cast<double>(k) * scenario.step_s();
    record.position_m = error_m(record.time_s);
    record.open_loop = record.time_s >= lost_from_s;
    meters.add(record);
  }
  return meters.values();
}

double value(const Values& values, std::string_view name) {
  for (std::size_t i = 0; i < measures.size(); ++i) {
    if (measures[i].name == name) return values[i];
  }
  FAIL("no such measure");
  return NAN;
}

}  // namespace

TEST_GROUP(Measures){};

TEST(Measures, WithoutAnEventCoverTheStartAndTheLast40Seconds) {
  const auto values = measured(scenario_of(100.0), [](double t) {
    return t < 3.0 ? 4e-3 : t < 10.0 ? -3e-3 : t < 20.0 ? 2e-3 : t < 60.0 ? 1.0 : 1e-6;
  });
  DOUBLES_EQUAL(4e-3, value(values, "start_rms_m"), 1e-12);
  DOUBLES_EQUAL(3e-3, value(values, "early_rms_m"), 1e-12);
  DOUBLES_EQUAL(2e-3, value(values, "learned_rms_m"), 1e-12);
  DOUBLES_EQUAL(1e-6, value(values, "steady_rms_m"), 1e-12);
  for (const char* name : {"changed_rms_m", "peak_m", "settling_s", "after_rms_m"})
    CHECK(std::isnan(value(values, name)));
}

TEST(Measures, WithAnEventCoverTheTimeBeforeAndAfter) {
  const auto values = measured(scenario_of(200.0, 100.0), [](double t) {
    if (t < 60.0) return 1.0;
    if (t < 100.0) return 1e-6;
    if (t < 101.5) return -3e-3;
    return t < 159.0 ? 1e-4 : t < 160.0 ? -5e-5 : 2e-6;
  });
  DOUBLES_EQUAL(1e-6, value(values, "steady_rms_m"), 1e-12);
  DOUBLES_EQUAL(std::sqrt((1.5 * 9e-6 + 8.5 * 1e-8) / 10.0), value(values, "changed_rms_m"), 1e-8);
  DOUBLES_EQUAL(3e-3, value(values, "peak_m"), 1e-12);
  DOUBLES_EQUAL(1.5, value(values, "settling_s"), 1e-9);
  DOUBLES_EQUAL(2e-6, value(values, "after_rms_m"), 1e-12);
  CHECK(std::isnan(value(values, "start_rms_m")));
}

TEST(Measures, AnErrorThatStaysNeverSettles) {
  const auto scenario = scenario_of(200.0, 100.0);
  CHECK(std::isinf(value(measured(scenario, [](double) { return 3e-4; }), "settling_s")));
  DOUBLES_EQUAL(0.0, value(measured(scenario, [](double) { return 1e-4; }), "settling_s"), 0.0);
}

TEST(Measures, ErrorsAreInfiniteOnceTrackingEnds) {
  const auto values = measured(
      scenario_of(200.0, 100.0), [](double) { return 0.0; }, 105.0);
  DOUBLES_EQUAL(0.0, value(values, "steady_rms_m"), 0.0);
  for (const char* name : {"changed_rms_m", "peak_m", "settling_s", "after_rms_m"})
    CHECK(std::isinf(value(values, name)));
}

TEST_GROUP(Statistics){};

TEST(Statistics, IntervalIsStudents) {
  const auto s = statistics_of({1.0, 2.0, 3.0, 4.0, 5.0});
  CHECK_EQUAL(5, s.runs);
  DOUBLES_EQUAL(3.0, s.mean, 1e-12);
  DOUBLES_EQUAL(5.0, s.worst, 0.0);
  // t for four degrees of freedom, 2.77645, times √(2.5/5).
  DOUBLES_EQUAL(2.7764451 * std::sqrt(0.5), s.half_width, 1e-6);
}

TEST(Statistics, ASingleRunAndAnInfiniteOneHaveNoInterval) {
  CHECK(std::isnan(statistics_of({2.0}).half_width));
  const auto s = statistics_of({2.0, INFINITY});
  CHECK(std::isinf(s.mean));
  CHECK(std::isinf(s.worst));
  CHECK(std::isnan(s.half_width));
}
