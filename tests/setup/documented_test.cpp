// What setup asks has the ranges and defaults that docs/setup.md gives.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "apps/supercoil/setup/muscle_answers.hpp"
#include "apps/supercoil/setup/nameplate.hpp"
#include "support/documented_ranges.hpp"

using namespace supercoil;
using namespace supercoil::operating;

TEST_GROUP(DocumentedSetup){};

TEST(DocumentedSetup, QuestionsHaveTheRangesAndDefaultsOfTheDocs) {
  const auto documented = test::documented_ranges(SUPERCOIL_DOCS "/setup.md");
  std::vector<Question> all(questions.begin(), questions.end());
  all.insert(all.end(), nameplate_questions.begin(), nameplate_questions.end());
  for (const Question& question : all) {
    const auto row = std::ranges::find(documented, question.key, &test::DocumentedRange::key);
    const std::string key(question.key);
    CHECK_TEXT(row != documented.end(), key.c_str());
    DOUBLES_EQUAL_TEXT(question.allowed.min, row->min, 0.0, key.c_str());
    DOUBLES_EQUAL_TEXT(question.allowed.max, row->max, 0.0, key.c_str());
    CHECK_EQUAL_TEXT(std::isnan(question.fallback), std::isnan(row->fallback), key.c_str());
    if (!std::isnan(row->fallback))
      DOUBLES_EQUAL_TEXT(question.fallback, row->fallback, 0.0, key.c_str());
  }
}
