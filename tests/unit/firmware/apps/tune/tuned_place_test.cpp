#include "apps/supercoil/tuned_place.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace supercoil::operating;

TEST_GROUP(TunedPlace) {
  /// A board with controllers and estimators of these kinds.
  static ReadTunable board(const std::vector<double>& controllers,
                           const std::vector<double>& estimators) {
    return [=](int place, std::size_t tunable, TuningSet) -> Result<double> {
      LONGS_EQUAL(0, tunable);
      const auto at = static_cast<std::size_t>(place);
      const auto& of = at < first_estimator_place ? controllers : estimators;
      const std::size_t i = at < first_estimator_place ? at : at - first_estimator_place;
      return i < of.size() ? of[i] : NAN;
    };
  }
  static constexpr double pi = 1.0;
  static constexpr double mrac = 3.0;
  static constexpr double gradient = 1.0;
};

TEST(TunedPlace, IsFoundByNumberOrByAUniqueKind) {
  const std::vector<std::string> kinds{"mrac", "pi", "pi"};
  LONGS_EQUAL(2, find_place(Tuned::controller, "2", kinds).value());
  LONGS_EQUAL(0, find_place(Tuned::controller, "mrac", kinds).value());
  STRCMP_EQUAL("several controllers are pi: write the number; there are 0 (mrac), 1 (pi), 2 (pi)",
               find_place(Tuned::controller, "pi", kinds).error().text().c_str());
  STRCMP_EQUAL("there is no controller 3; there are 0 (mrac), 1 (pi), 2 (pi)",
               find_place(Tuned::controller, "3", kinds).error().text().c_str());
  STRCMP_EQUAL("there is no estimator 1; there is 0 (gradient)",
               find_place(Tuned::estimator, "1", {"gradient"}).error().text().c_str());
  STRCMP_EQUAL(
      "there is no estimator none",
      find_place(Tuned::estimator, "none", std::vector<std::string>{}).error().text().c_str());
}

TEST(TunedPlace, ItsKindDecidesBetweenControllerAndEstimator) {
  const ReadTunable read_value = board({mrac, pi}, {gradient});
  LONGS_EQUAL(1, find_any_place("pi", read_value).value());
  LONGS_EQUAL(1, find_any_place("1", read_value).value());
  LONGS_EQUAL(first_estimator_place, find_any_place("gradient", read_value).value());
  LONGS_EQUAL(first_estimator_place, find_any_place("8", read_value).value());
  STRCMP_EQUAL("there is no controller 5; there are 0 (mrac), 1 (pi)",
               find_any_place("5", read_value).error().text().c_str());
  STRCMP_EQUAL("there is no estimator 1; there is 0 (gradient)",
               find_any_place("9", read_value).error().text().c_str());
}

TEST(TunedPlace, ABoardThatDoesNotAnswerIsReported) {
  const auto silent = [](int, std::size_t, TuningSet) -> Result<double> {
    return failure("no answer", std::errc::timed_out);
  };
  const auto found = find_place(Tuned::controller, "0", silent);
  CHECK(!found && found.error().code == std::errc::timed_out);
}
