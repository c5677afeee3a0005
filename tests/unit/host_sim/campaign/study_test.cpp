// A study as its author writes it, and the scenarios of its runs.
#include "campaign/study.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <CppUTest/TestHarness.h>

#include "campaign/draws.hpp"
#include "campaign/results.hpp"
#include "campaign/statistics.hpp"

using namespace supercoil::host_sim;
using namespace supercoil::host_sim::campaign;

namespace {

/// The text as a file that exists for the lifetime of this object.
class StudyFile {
 public:
  explicit StudyFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() / "supercoil-study.toml") {
    std::ofstream(path_) << text;
  }
  StudyFile(const StudyFile&) = delete;
  StudyFile& operator=(const StudyFile&) = delete;
  ~StudyFile() { std::filesystem::remove(path_); }

  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

Study study_of(const std::string& text) {
  const StudyFile file(text);
  auto study = read_study(file.path());
  if (!study) FAIL(supercoil::config::to_text(study.error()).c_str());
  return *study;
}

void check_problem(const std::string& expected, const std::string& text) {
  const StudyFile file(text);
  const auto study = read_study(file.path());
  CHECK(!study);
  STRCMP_CONTAINS(expected.c_str(), supercoil::config::to_text(study.error()).c_str());
}

/// A draw of a stiffness, with additional lines.
std::string draw(const std::string& lines) {
  return "[[draw]]\nkeys = 'plant.stiffness_N_per_m'\n" + lines + "\n";
}

double number(const Study& study, std::size_t run, const char* key) {
  const Draws draws(study);
  const auto document = draws.document(draws.of_run(run), 0, run);
  if (!document) FAIL(document.error().text().c_str());
  return document->at_path(key).value_or(std::nan(""));
}

}  // namespace

TEST_GROUP(Study){};

TEST(Study, ErrorsNameTheProblemAndItsLine) {
  check_problem("study.toml:2: study.run = 5: is not a key of [study]; did you mean runs?",
                "[study]\nrun = 5");
  check_problem("study.runs = 0: must be 1 to 1000000", "[study]\nruns = 0");
  check_problem("study.sampling = 'dice': must be one of: sobol, latin_hypercube, random",
                "[study]\nsampling = 'dice'");
  check_problem("study.scenario = 'sin': is not a built-in scenario; did you mean sine?",
                "[study]\nscenario = 'sin'");
  check_problem("study.controllers = 'mrc': --controllers mrc: must be a .toml file or one of: pi",
                "[study]\ncontrollers = 'mrc'");
  check_problem("goals.tracking_rms_um = 5: is not a key of [goals]; did you mean tracking_rms_m?",
                "[goals]\ntracking_rms_um = 5");
  check_problem("study.toml:1: scenario = 5: must be tables, such as [scenario.plant]",
                "scenario = 5");
  check_problem("none-such.toml: there is no such file", "[study]\nscenario = './none-such.toml'");
  check_problem("study.window_s", "[study]\nwindow_s = [50.0, 20.0]");
  check_problem("a Latin hypercube is valid only when all its runs are complete",
                "[study]\nsampling = 'latin_hypercube'\nknown_to = 0.01");
}

TEST(Study, ErrorsNameTheProblemOfADraw) {
  check_problem("draw[1].constant: is missing: it must be a number\n", draw(""));
  check_problem("log_uniform = [1, 2]: conflicts with uniform: give exactly one distribution",
                draw("uniform = [1.0, 2.0]\nlog_uniform = [1.0, 2.0]"));
  check_problem("draw[1].uniform = [2, 1]: the second value must be greater than the first",
                draw("uniform = [2.0, 1.0]"));
  check_problem(
      "draw[1].log_uniform = [0, 1]: must be a list of 2 numbers, each 1e-300 or more; 0 is not",
      draw("log_uniform = [0.0, 1.0]"));
  check_problem("the standard deviation must be above 0", draw("normal = [1.0, 0.0]"));
  check_problem("min = 50: almost none of the distribution lies between min and max",
                draw("normal = [0.0, 1.0]\nmin = 50.0\nmax = 51.0"));
  check_problem("list = ['a,b']: must not contain a text with a comma", draw("list = ['a,b']"));
  check_problem("list = []: must be a list of numbers, texts, true or false", draw("list = []"));
  check_problem("list = [[1]]: must be a list of numbers, texts, true or false",
                draw("list = [[1.0]]"));
  check_problem("uniform = 5: must be a list of 2 numbers\n", draw("uniform = 5"));
  check_problem("normal = 5: must be a list of 2 numbers\n", draw("normal = 5"));
  check_problem("min = 'low': must be a number\n", draw("normal = [0.0, 1.0]\nmin = 'low'"));
  check_problem("it cannot be combined with times or over", draw("list = [1.0]\ntimes = 'x'"));
  check_problem("needs group: the draws to correlate with",
                draw("uniform = [1.0, 2.0]\ncorrelation = 0.5"));
  check_problem("is missing, and so is name: give at least one of them",
                "[[draw]]\nuniform = [1.0, 2.0]");
  check_problem("plant.stiffness_N_per_m is drawn twice",
                draw("uniform = [1.0, 2.0]") + draw("uniform = [1.0, 2.0]"));
}

TEST(Study, EachMistakeIsToldOnce) {
  const auto problems = [](const std::string& text) {
    const StudyFile file(text);
    return read_study(file.path()).error().size();
  };
  CHECK_EQUAL(std::size_t{1}, problems("[study]\ncontrollers = ['pi', 3, '']"));
  CHECK_EQUAL(std::size_t{1}, problems(draw("uniform = [1.0, 2.0]\nconstant = 1.0")));
  CHECK_EQUAL(std::size_t{1}, problems(draw("normal = [1.0, 2.0]\nuniform = [1.0, 2.0]")));
  CHECK_EQUAL(std::size_t{2}, problems("[[draw]]\nconstant = 1.0\n[[draw]]\nconstant = 1.0"));
}

TEST(Study, AnUnknownNameSuggestsTheNearestStudy) {
  const auto study = read_study("folows");
  CHECK(!study);
  STRCMP_CONTAINS("did you mean follows?", supercoil::config::to_text(study.error()).c_str());
}

/// A thousand runs of the sine would answer no question.
TEST(Study, AnEmptyFileIsRefused) {
  for (const char* text : {"", "# temperature.toml, to be written\n"})
    check_problem("is empty: a study has at least one of [study], [[draw]], [goals]", text);
}

TEST(Study, AFaultIsAFailureByDefault) {
  const std::size_t faults = *find_quantity("faults");
  const auto goal = [&](const Study& study) {
    return std::ranges::find(study.goals, faults, &Goal::quantity)->max;
  };
  DOUBLES_EQUAL(0.0, goal(study_of("[study]")), 0.0);
  DOUBLES_EQUAL(3.0, goal(study_of("[goals]\nfaults = 3")), 0.0);
}

TEST(Study, StoppingCriteriaAreNotPartOfARunsDefinition) {
  const Study one = study_of("[study]\nruns = 10");
  CHECK(one.definition ==
        study_of("[study]\nruns = 20\nknown_to = 0.1\n[goals]\nhottest_C = 90.0").definition);
  CHECK(one.definition != study_of("[study]\nruns = 10\nseed = 2").definition);
  CHECK(one.definition != study_of("[study]\nruns = 10\n" + draw("constant = 1.0")).definition);
  const auto latin = [](const char* runs) {
    return study_of(std::string("[study]\nsampling = 'latin_hypercube'\nruns = ") + runs)
        .definition;
  };
  CHECK(latin("10") != latin("20"));
}

TEST(Study, DrawsAreMultipliedAndDividedByDrawsAndScenarioValues) {
  const Study study = study_of(
      "[study]\nruns = 3\n[scenario.plant]\nmoving_mass_kg = 0.5\n"
      "[[draw]]\nname = 'factor'\nuniform = [2.0, 3.0]\n" +
      draw("constant = 10.0\ntimes = ['factor', 'factor']\nover = 'plant.moving_mass_kg'"));
  for (std::size_t run = 0; run < 3; ++run) {
    const double factor = Draws(study).of_run(run)[0];
    CHECK(factor > 2.0 && factor < 3.0);
    DOUBLES_EQUAL(10.0 * factor * factor / 0.5, number(study, run, "plant.stiffness_N_per_m"),
                  1e-12);
  }
}

TEST(Study, ANumberOfAListMayBeAFactor) {
  const Study study = study_of("[study]\n[[draw]]\nname = 'factor'\nlist = [2, 2.0]\n" +
                               draw("constant = 10.0\ntimes = 'factor'"));
  DOUBLES_EQUAL(20.0, number(study, 0, "plant.stiffness_N_per_m"), 0.0);
  DOUBLES_EQUAL(20.0, number(study, 1, "plant.stiffness_N_per_m"), 0.0);
}

TEST(Study, ADrawThatNamesAnUnknownFactorIsRefused) {
  const Study study = study_of("[study]\n" + draw("constant = 1.0\ntimes = 'plant.colour'"));
  const auto scenario = Draws(study).scenario(Draws(study).medians(), 0, 0);
  CHECK(!scenario);
  STRCMP_CONTAINS("times or over names plant.colour, which is neither an earlier draw nor a number",
                  supercoil::config::to_text(scenario.error()).c_str());
}

TEST(Study, SetsElementsOfListsAndEvents) {
  const Study study = study_of(
      "[study]\n[scenario.reference]\nkind = 'steps'\nlevels_m = [0.001, 0.002]\nhold_s = 5.0\n"
      "[[scenario.event]]\nat_s = 1.0\nplant.load_N = 0.0\n"
      "[[draw]]\nkeys = 'reference.levels_m[1]'\nconstant = 0.005\n"
      "[[draw]]\nkeys = ['event[0].plant.load_N', 'event[0].power.gain']\nconstant = 0.25\n");
  DOUBLES_EQUAL(0.001, number(study, 0, "reference.levels_m[0]"), 0.0);
  DOUBLES_EQUAL(0.005, number(study, 0, "reference.levels_m[1]"), 0.0);
  DOUBLES_EQUAL(0.25, number(study, 0, "event[0].plant.load_N"), 0.0);
  DOUBLES_EQUAL(0.25, number(study, 0, "event[0].power.gain"), 0.0);
  for (const char* key : {"reference.levels_m[2]", "reference.levels_m[x]", "plant[0].load_N",
                          "reference.kind.x", "event.load_N", "..", "[0]"}) {
    const Study wrong = study_of(
        "[study]\n[scenario.reference]\nkind = 'steps'\n"
        "levels_m = [0.001, 0.002]\nhold_s = 5.0\n[[scenario.event]]\n"
        "at_s = 1.0\n[[draw]]\nkeys = '" +
        std::string(key) + "'\nconstant = 0.1\n");
    CHECK_TEXT(!Draws(wrong).document({0.1}, 0, 0), key);
  }
}

TEST(Study, ItsControllersReplaceThoseOfItsEvents) {
  const Study study = study_of(
      "[study]\nscenario = 'pwm'\ncontrollers = ['pd_ff']\n[[scenario.event]]\nat_s = 1.0\n"
      "plant.load_N = 0.1\ncontroller.kind = 'pi'\nestimator.kind = 'none'\n" +
      draw("constant = 16.0"));
  const Draws draws(study);
  const auto scenario = draws.scenario(draws.of_run(0), 0, 0);
  if (!scenario) FAIL(supercoil::config::to_text(scenario.error()).c_str());
  CHECK_FALSE(scenario->events[0].new_controller);
  CHECK_FALSE(scenario->events[0].new_estimator);
  DOUBLES_EQUAL(0.1, scenario->events[0].conditions.plant.load_N, 0.0);
}

TEST(Study, ListValuesKeepTheirType) {
  const Study study = study_of(
      "[study]\nruns = 40\n[[draw]]\nkeys = 'plant.preset'\nlist = ['real', 'b']\n"
      "[[draw]]\nkeys = 'power.pwm_bits'\nlist = [10, 12]\n");
  int real = 0;
  for (std::size_t run = 0; run < 40; ++run) {
    const Draws draws(study);
    const auto document = draws.document(draws.of_run(run), 0, run);
    real += document->at_path("plant.preset").value_or(std::string()) == "real" ? 1 : 0;
    CHECK(document->at_path("power.pwm_bits").is_integer());
  }
  CHECK(real >= 15 && real <= 25);
  STRCMP_EQUAL("b", text_of(study.draws[0], 1.0).c_str());
  STRCMP_EQUAL("12", text_of(study.draws[1], 1.0).c_str());
}

TEST(Study, DrawsOfAGroupAreCorrelated) {
  const auto correlation = [](const char* of_one) {
    const Study study = study_of(
        "[study]\nruns = 2000\nsampling = 'random'\n"
        "[[draw]]\nname = 'a'\nuniform = [0.0, 1.0]\ngroup = 'size'\n"
        "[[draw]]\nname = 'b'\nlog_uniform = [1.0, 100.0]\ngroup = 'size'\ncorrelation = " +
        std::string(of_one));
    std::vector<double> a;
    std::vector<double> b;
    const Draws draws(study);
    for (std::size_t run = 0; run < 2000; ++run) {
      const auto drawn = draws.of_run(run);
      a.push_back(drawn[0]);
      b.push_back(drawn[1]);
    }
    return rank_correlation(a, b);
  };
  DOUBLES_EQUAL(1.0, correlation("1.0"), 1e-6);
  DOUBLES_EQUAL(-1.0, correlation("-1.0"), 1e-6);
  // The ranks of two normal variables with correlation 0.5 have 6/pi asin(0.25) = 0.4826.
  DOUBLES_EQUAL(0.4826, correlation("0.5"), 0.05);
  DOUBLES_EQUAL(0.0, correlation("0.0"), 0.06);
}

TEST(Study, SeverityIsThatOfTheWorstMissedGoal) {
  const Study study = study_of("[goals]\ntracking_rms_m = 10e-6\nhottest_C = 100.0");
  Outcome outcome;
  outcome.values.fill(0.0);
  const auto set = [&](const char* name, double value) {
    outcome.values.at(*find_quantity(name)) = value;
  };
  set("tracking_rms_m", 5e-6);
  set("hottest_C", 80.0);
  DOUBLES_EQUAL(0.8, severity(study, outcome), 1e-12);
  set("tracking_rms_m", 20e-6);
  DOUBLES_EQUAL(2.0, severity(study, outcome), 1e-12);
  set("tracking_rms_m", std::nan(""));
  CHECK(std::isinf(severity(study, outcome)));
  set("tracking_rms_m", 5e-6);
  set("faults", 1.0);
  CHECK(std::isinf(severity(study, outcome)));
}

TEST(Study, EveryBuiltInStudyIsAValidScenarioAtItsMedians) {
  CHECK(builtin_studies().size() >= 3);
  for (const BuiltinScenario& builtin : builtin_studies()) {
    const auto study = read_study(std::string(builtin.name));
    if (!study) FAIL(supercoil::config::to_text(study.error()).c_str());
    const Draws draws(*study);
    for (std::size_t i = 0; i < study->contenders.size(); ++i) {
      const auto scenario = draws.scenario(draws.medians(), i, 0);
      if (!scenario) FAIL(supercoil::config::to_text(scenario.error()).c_str());
    }
  }
}
