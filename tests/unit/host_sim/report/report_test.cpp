#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>

#include <CppUTest/TestHarness.h>

#include "plot/figure.hpp"
#include "report/reproduction_table.hpp"
#include "report/run_plot.hpp"
#include "report/trace_writer.hpp"
#include "unit/host_sim/support/content.hpp"

namespace fs = std::filesystem;
using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::content;

namespace {

Figure one_curve(const std::string& title) {
  Figure figure;
  figure.panels.push_back({title, "time (s)", "mm", {{"curve", {0.0, 1.0, 2.0}, {0.0, 1.0, 4.0}}}});
  return figure;
}

}  // namespace

TEST_GROUP(Report) {
  fs::path folder;
  void setup() override {
    std::string name = (fs::temp_directory_path() / "supercoil-test-XXXXXX").string();
    CHECK(mkdtemp(name.data()) != nullptr);
    folder = name;
  }
  void teardown() override {
    fs::remove_all(folder);
  }
};

TEST(Report, AJointsTraceEndsWithTheAntagonistsColumns) {
  Conditions conditions;
  conditions.joint.emplace().antagonist.emplace();
  const auto writer = write_trace(folder / "trace.csv", TraceFormat::csv, 1, &conditions);
  TickRecord record;
  record.antagonist = AntagonistRecord{0.5, 12.0, 10.0, 14.5, LimitedBy::maximum};
  writer->add(record, std::nullopt);
  CHECK(writer->finish().has_value());
  const std::string text = content(folder / "trace.csv");
  CHECK(text.find(",thermometer_C,joint_angle_deg,joint_reference_deg,antagonist_applied_power_W,"
                  "antagonist_temperature_rise_K,"
                  "antagonist_coldest_K,antagonist_hottest_K,antagonist_limited_by\n") !=
        std::string::npos);
  CHECK(text.find(",0,0,0.5,12,10,14.5,maximum\n") != std::string::npos);
}

TEST(Report, ABundlesTraceEndsWithItsMusclesColumns) {
  Conditions conditions;
  conditions.companions.resize(2);
  const auto writer = write_trace(folder / "trace.csv", TraceFormat::csv, 1, &conditions);
  TickRecord record;
  record.bundle = BundleRecord{10.0, 12.0, 14.5, false};
  writer->add(record, std::nullopt);
  CHECK(writer->finish().has_value());
  const std::string text = content(folder / "trace.csv");
  CHECK(text.find(",thermometer_C,bundle_min_temperature_rise_K,bundle_max_temperature_rise_K,"
                  "bundle_hottest_K\n") != std::string::npos);
  CHECK(text.find(",10,12,14.5\n") != std::string::npos);
}

TEST(Report, AJointsTraceHasAngleAndReferenceByItsLever) {
  Conditions conditions;
  JointConditions& joint = conditions.joint.emplace();  // a spring opposes the muscle
  const double rad_per_deg = std::numbers::pi / 180.0;
  const std::array radii_m{0.010, 0.020, 0.030};
  joint.plant.lever = control::Lever(-90.0 * rad_per_deg, 90.0 * rad_per_deg, radii_m);
  const auto writer = write_trace(folder / "trace.csv", TraceFormat::csv, 1, &conditions);
  TickRecord record;
  // By hand: the lever is 25 mm at 45 degrees and 10 mm at -90.
  record.position_m = 0.0225 * 45.0 * rad_per_deg;
  record.model_m = -0.015 * 90.0 * rad_per_deg;
  writer->add(record, std::nullopt);
  record.open_loop = true;
  writer->add(record, std::nullopt);
  CHECK(writer->finish().has_value());
  std::ifstream rows(folder / "trace.csv");
  std::string row;
  std::getline(rows, row);
  CHECK(row.ends_with(",thermometer_C,joint_angle_deg,joint_reference_deg"));
  std::getline(rows, row);
  const std::size_t reference = row.rfind(',') + 1;
  DOUBLES_EQUAL(-90.0, std::stod(row.substr(reference)), 1e-9);
  DOUBLES_EQUAL(45.0, std::stod(row.substr(row.rfind(',', reference - 2) + 1)), 1e-9);
  std::getline(rows, row);
  CHECK(row.ends_with(","));  // no model is followed
}

TEST(Report, TraceHoldsOneRowATickWithAllDigits) {
  const auto writer = write_trace(folder / "trace.csv", TraceFormat::csv, 2);
  CHECK(writer->is_due(0));
  CHECK_FALSE(writer->is_due(1));
  TickRecord record;
  record.time_s = 0.1 + 0.2;
  record.reference = 0.011;
  record.applied_power_W = 1.0 / 3.0;
  record.limited = true;
  control::Estimate estimate{control::Theta{1.0, 2.0, 3.0, 4.0}, 0.0, 0.0, 0.0, true};
  writer->add(record, estimate);
  estimate.bias_W = 0.5;
  estimate.deviation = control::Theta{0.1, 0.2, 0.3, 0.4};
  estimate.bias_deviation_W = 0.25;
  record.thermometer_C = 31.5;
  writer->add(record, estimate);
  record.thermometer_C = NAN;
  record.open_loop = record.commands_power = true;
  record.state = State::fault;
  record.fault = Fault::heater_open;
  record.limited_by = LimitedBy::temperature;
  writer->add(record, std::nullopt);
  CHECK(writer->finish().has_value());
  STRCMP_EQUAL(
      "time_s,reference_m,model_m,position_m,measured_m,power_W,applied_power_W,"
      "temperature_rise_K,limited,theta1,theta2,theta3,theta4,trusted,reference_power_W,"
      "coldest_K,hottest_K,state,fault,limited_by,bias_W,theta1_deviation,theta2_deviation,"
      "theta3_deviation,theta4_deviation,bias_deviation_W,thermometer_C\n"
      "0.30000000000000004,0.011,0,0,0,0,0.3333333333333333,0,1,1,2,3,4,1,,0,0,disarmed,none,"
      "nothing,,,,,,,\n"
      "0.30000000000000004,0.011,0,0,0,0,0.3333333333333333,0,1,1,2,3,4,1,,0,0,disarmed,none,"
      "nothing,0.5,0.1,0.2,0.3,0.4,0.25,31.5\n"
      "0.30000000000000004,,,0,0,0,0.3333333333333333,0,1,,,,,,0.011,0,0,fault,heater_open,"
      "temperature,,,,,,,\n",
      content(folder / "trace.csv").c_str());
}

TEST(Report, EveryFaultNameFitsInANumpyTrace) {
  const auto writer = write_trace(folder / "trace.npy", TraceFormat::npy, 1);
  TickRecord record;
  for (const FaultInfo& info : all_faults()) {
    record.fault = info.fault;
    writer->add(record, std::nullopt);
  }
  CHECK(writer->finish().has_value());
  const std::string text = content(folder / "trace.npy");
  for (const FaultInfo& info : all_faults()) {
    const std::string name(info.name);
    CHECK_TEXT(text.find(name + std::string(24 - name.size(), '\0')) != std::string::npos,
               name.c_str());
  }
}

TEST(Report, TraceReportsAFullDisk) {
  for (const TraceFormat format : {TraceFormat::csv, TraceFormat::npy}) {
    const auto writer = write_trace("/dev/full", format, 1);
    writer->add({}, std::nullopt);
    const auto finished = writer->finish();
    CHECK_FALSE(finished.has_value());
    STRCMP_EQUAL(
        (std::string(trace_file(format)) + ": cannot be written: No space left on device").c_str(),
        finished.error().text().c_str());
  }
}

TEST(Report, FigureIsDrawnByGnuplotForAnyTitle) {
  const auto drawn =
      draw(one_curve("a \"quoted\" 'title' with \\, $HOME and `touch ran`"), folder / "a b.svg");
  CHECK_TEXT(drawn.has_value(), drawn.has_value() ? "" : drawn.error().text().c_str());
  const std::string svg = content(folder / "a b.svg");
  STRCMP_CONTAINS("</svg>", svg.c_str());
  STRCMP_CONTAINS("a \"quoted\" 'title' with \\, $HOME and `touch ran`", svg.c_str());
  LONGS_EQUAL(1, std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Report, FigureMayHaveLogarithmicAxesInOnePanelOnly) {
  Figure figure = one_curve("logarithmic");
  figure.panels[0].x_logarithmic = figure.panels[0].y_logarithmic = true;
  figure.panels.push_back(one_curve("linear").panels[0]);
  const std::string script = gnuplot_script(figure, "x.svg");
  for (const char* axis : {"x", "y"}) {
    const std::string set = std::string("set logscale ") + axis + "\n";
    CHECK(script.find("\n" + set) < script.find("'linear'"));
    CHECK(script.find("\nun" + set) < script.find("plot $d1"));
    CHECK(script.find("\nun" + set) > script.find("plot $d0"));
  }
}

TEST(Report, PanelDoesNotInheritTheRangeOfThePreviousOne) {
  Figure figure = one_curve("cut");
  figure.panels[0].x_high = 0.5;
  figure.panels.push_back(one_curve("whole").panels[0]);
  const std::string script = gnuplot_script(figure, "x.svg");
  CHECK(script.find("set xrange [*:*]") > script.find("set xrange [0:0.5]"));
  CHECK(script.find("set xrange [*:*]") < script.find("plot $d1"));
}

TEST(Report, FigureLeavesAGapWhereAValueIsNotFinite) {
  Figure figure = one_curve("gap");
  figure.panels[0].curves[0].y[1] = std::numeric_limits<double>::quiet_NaN();
  STRCMP_CONTAINS("$d0 << EOD\n0 0\n\n2 4\nEOD\n", gnuplot_script(figure, "x.svg").c_str());
}

TEST(Report, FigureThatCannotBeWrittenIsAnError) {
  CHECK_FALSE(draw(one_curve("nowhere"), folder / "no" / "where.svg").has_value());
}

TEST(Report, TableQuotesFieldsAsCsvRequires) {
  const paper::Part part{"t", "i", {{"id", "a,b", "say \"x\"", "m", "1", "2", ""}}, {}};
  STRCMP_EQUAL("id,case,quantity,unit,paper,measured,remark\nid,\"a,b\",\"say \"\"x\"\"\",m,1,2,\n",
               to_csv({part}).c_str());
}

TEST(Report, PageIsSelfContained) {
  paper::Part part{"Title <1>", "i", {{"id", "c", "q", "m", "< 5", "2", ""}}, {}};
  part.figures.push_back({"f", "Figure", "caption", {}});
  const std::string html = to_html({part}, {"<svg/>"});
  STRCMP_CONTAINS("Title &lt;1&gt;", html.c_str());
  STRCMP_CONTAINS("<td class=\"n\">&lt; 5</td>", html.c_str());
  STRCMP_CONTAINS("src=\"data:image/svg+xml;base64,PHN2Zy8+\"", html.c_str());
  CHECK(html.find("http") == std::string::npos);
}
