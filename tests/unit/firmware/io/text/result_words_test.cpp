#include "text/result_words.hpp"

#include <fstream>
#include <map>
#include <string>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

namespace {

/// The meaning of each result in docs/running.md: | `name` | of | means |
std::map<std::string, std::string> documented() {
  std::ifstream file(SUPERCOIL_DOCS "/running.md");
  std::map<std::string, std::string> rows;
  bool in_table = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| result |")) in_table = true;
    if (!in_table || !line.starts_with("| `")) {
      in_table = in_table && !line.empty();
      continue;
    }
    const std::string name = line.substr(3, line.find('`', 3) - 3);
    const std::size_t end = line.rfind(" |");
    const std::size_t begin = line.rfind("| ", end - 1) + 2;
    rows[name] = line.substr(begin, end - begin);
  }
  return rows;
}

}  // namespace

TEST_GROUP(ResultWords){};

TEST(ResultWords, MatchTheDocumentation) {
  const auto rows = documented();
  UNSIGNED_LONGS_EQUAL(mode_result_names.size(), rows.size());
  for (std::size_t i = 0; i < mode_result_names.size(); ++i) {
    const std::string name(mode_result_names[i]);
    CHECK_TEXT(rows.contains(name), name.c_str());
    STRCMP_EQUAL(std::string(result_words[i]).c_str(), rows.at(name).c_str());
  }
}

TEST(ResultWords, EveryNoteHasAnExplanation) {
  for (const std::string_view words : note_words)
    CHECK_FALSE(words.empty());
}

TEST(ResultWords, FollowTheNameWithoutRepetition) {
  const std::string still =
      "too_little_motion: the muscle moved by less than 1 % of its travel at the maximum power";
  STRCMP_EQUAL(still.c_str(), result_text("too_little_motion", "too_little_motion").c_str());
  STRCMP_EQUAL((still + "; theta1_kept, friction").c_str(),
               result_text("too_little_motion", "theta1_kept,too_little_motion,friction").c_str());
  STRCMP_EQUAL("not_cold: the muscle did not cool within two minutes",
               result_text(ModeResult::not_cold, 0).c_str());
  STRCMP_EQUAL("found; theta1_kept", result_text(ModeResult::found, note_theta1_kept).c_str());
}

TEST(ResultWords, AKnownCauseReplacesThem) {
  STRCMP_EQUAL("interrupted, by Ctrl-C", result_text("interrupted", "", "by Ctrl-C").c_str());
  STRCMP_EQUAL("interrupted: ended by a command or a fault",
               result_text("interrupted", "").c_str());
}

TEST(ResultWords, AnUnknownResultIsShownByName) {
  STRCMP_EQUAL("12; theta1_kept", result_text("12", "theta1_kept").c_str());
}
