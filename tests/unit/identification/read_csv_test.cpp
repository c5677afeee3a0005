// Recordings as laboratories write them, and the problems of those that cannot be read.
#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/identification/recording.hpp"

namespace {

using supercoil::identification::Columns;
using supercoil::identification::Problem;
using supercoil::identification::read_csv;
using supercoil::identification::Recording;

Recording read_well(const std::string& text, const Columns& columns = {}) {
  const auto recording = read_csv(text, columns);
  if (!recording) FAIL(recording.error().text.c_str());
  return *recording;
}

Problem refused(const std::string& text, const Columns& columns = {}) {
  const auto recording = read_csv(text, columns);
  CHECK_TEXT(!recording, "it was read");
  return recording ? Problem{} : recording.error();
}

void check_problem(const Problem& problem, std::size_t line, const std::string& part) {
  UNSIGNED_LONGS_EQUAL(line, problem.line);
  STRCMP_CONTAINS(part.c_str(), problem.text.c_str());
}

}  // namespace

TEST_GROUP(ReadCsv){};

TEST(ReadCsv, ReadsColumnsInAnyOrderByTheirNames) {
  const Recording r = read_well("power_W,spare,time_s,position_m\n1.5,x,0,0.001\n2,y,0.01,2e-3\n");
  UNSIGNED_LONGS_EQUAL(2, r.size());
  DOUBLES_EQUAL(0.01, r.time_s[1], 0.0);
  DOUBLES_EQUAL(0.002, r.position_m[1], 0.0);
  DOUBLES_EQUAL(1.5, r.power_W[0], 0.0);
  UNSIGNED_LONGS_EQUAL(3, r.line[1]);
}

TEST(ReadCsv, TakesUnitsFromNamesAndOptions) {
  const Recording named = read_well("Time [ms];Position (mm);power_mW\n20;1,5;300\n");
  DOUBLES_EQUAL(0.02, named.time_s[0], 1e-15);
  DOUBLES_EQUAL(0.0015, named.position_m[0], 1e-15);
  DOUBLES_EQUAL(0.3, named.power_W[0], 1e-15);
  const Columns columns{{"clock", "ms", 1.0}, {"2", "um", -1.0}, {"heated", "", 2.5}};
  const Recording recording = read_well("clock,length,heated\n20,1500,1\n", columns);
  DOUBLES_EQUAL(0.02, recording.time_s[0], 1e-15);
  DOUBLES_EQUAL(-0.0015, recording.position_m[0], 1e-15);
  DOUBLES_EQUAL(2.5, recording.power_W[0], 1e-15);
}

TEST(ReadCsv, PrefersMeasuredPositionAndAppliedPower) {
  const Recording r =
      read_well("time_s,position_m,measured_m,power_W,applied_power_W\n0,0.001,0.002,3,4\n");
  DOUBLES_EQUAL(0.002, r.position_m[0], 0.0);
  DOUBLES_EQUAL(4.0, r.power_W[0], 0.0);
}

TEST(ReadCsv, OfAJointsTwoHeatersOneMustBeNamed) {
  const std::string trace =
      "time_s,position_m,applied_power_W,antagonist_applied_power_W\n0,0.001,3,4\n";
  check_problem(refused(trace), 1,
                "is of a joint: two heaters move it, by applied_power_W and "
                "antagonist_applied_power_W, and only one would be fitted");
  Columns columns;
  columns.power.name = "applied_power_W";
  const auto named = read_csv(trace, columns);
  CHECK(named.has_value());
  DOUBLES_EQUAL(3.0, named->power_W[0], 0.0);
}

TEST(ReadCsv, SkipsCommentsEmptyLinesAndAByteOrderMark) {
  const Recording r =
      read_well("\xEF\xBB\xBF# bench 3\r\ntime_s\tposition_m\tpower_W\r\n\r\n0\t1\t2\r\n");
  UNSIGNED_LONGS_EQUAL(1, r.size());
  UNSIGNED_LONGS_EQUAL(4, r.line[0]);
}

TEST(ReadCsv, ReadsColumnsThatSpacesSeparate) {
  const Recording r = read_well("t   x   p\n 0.5   0.001  2.0\n");
  DOUBLES_EQUAL(0.5, r.time_s[0], 0.0);
  DOUBLES_EQUAL(2.0, r.power_W[0], 0.0);
}

TEST(ReadCsv, OnlyPositionMayBeMissing) {
  const Recording r = read_well("time_s,position_m,power_W\n0,,1\n1,nan,1\n2,0.1,1\n");
  CHECK(std::isnan(r.position_m[0]));
  CHECK(std::isnan(r.position_m[1]));
  check_problem(refused("time_s,position_m,power_W\n0,1,1\n1,1,\n"), 3, "power_W is missing");
  check_problem(refused("time_s,position_m,power_W\nnan,1,1\n"), 2, "time_s is NaN");
}

TEST(ReadCsv, NamesTheLineOfABadRow) {
  const std::string head = "time_s,position_m,power_W\n0,0.1,1\n";
  check_problem(refused(head + "0.1,O.2,1\n"), 3, "position_m: \"O.2\" is not a number");
  check_problem(refused(head + "0.1,0.2\n"), 3, "has 2 fields; there are 3 columns");
  check_problem(refused(head + "0.1,0.2,1,7\n"), 3, "has 4 fields");
  check_problem(refused(head + "0.1,0.2,1 W\n"), 3, "\"1 W\" is not a number");
}

TEST(ReadCsv, NamesTheMissingColumnAndTheAvailableOnes) {
  check_problem(
      refused("time_s,position_m,heated\n0,1,1\n"), 1,
      "recognised as power; name it with --power-column; the columns are time_s, position_m, "
      "heated");
  const Columns columns{{}, {"lenght", "", 1.0}, {}};
  check_problem(refused("time_s,position_m,power_W\n0,1,1\n", columns), 1,
                "--position-column lenght: there is no such column");
  const Columns feet{{}, {"", "ft", 1.0}, {}};
  check_problem(refused("time_s,position_m,power_W\n0,1,1\n", feet), 0,
                "--position-unit ft: must be one of m, cm, mm, um");
  check_problem(refused("0,1,1\n1,1,1\n"), 1, "must name the columns");
  check_problem(refused(""), 0, "is empty");
}

TEST(ReadCsv, RequiresAChoiceBetweenSeveralChannels) {
  const std::string text =
      "time_s,channel,position_m,applied_W\n0,1,0.1,1\n0,2,0.5,2\n1,1,0.2,1\n1,2,0.6,2\n";
  check_problem(refused(text), 3, "another channel: choose one with --channel");
  const Recording second = read_well(text, {{}, {}, {}, 2});
  UNSIGNED_LONGS_EQUAL(2, second.size());
  DOUBLES_EQUAL(0.6, second.position_m[1], 0.0);
}
