#include "text/refusal_words.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(RefusalWords){};

TEST(RefusalWords, EveryRefusalHasAnExplanation) {
  STRCMP_EQUAL("", std::string(refusal_words(Refusal::none)).c_str());
  for (std::size_t i = 1; i < refusal_names.size(); ++i)
    CHECK_FALSE(refusal_words(static_cast<Refusal>(i)).empty());
}

TEST(RefusalWords, FollowTheName) {
  STRCMP_EQUAL("ok", answer_with_reason(Reply(Refusal::none)).c_str());
  STRCMP_EQUAL(
      "refused: wrong_state: arm it first, or reset its fault; or command the channel that leads "
      "its joint or bundle",
      answer_with_reason("1 position 0.01", "refused: wrong_state").c_str());
  STRCMP_EQUAL("refused: wrong_state: it has no fault",
               answer_with_reason("1 reset", "refused: wrong_state").c_str());
  STRCMP_EQUAL("refused: out_of_range; 0.025 would be obeyed",
               answer_with_reason({Refusal::out_of_range, 0.025}).c_str());
  STRCMP_EQUAL("refused: wrong_state: it follows no position, or the motion has ended",
               answer_with_reason(Reply(Refusal::wrong_state), Verb::knot).c_str());
  STRCMP_EQUAL(
      "refused: wrong_state: it is accepted while `power` heats steadily; 0, which forgets it, "
      "while the muscle rests",
      answer_with_reason("1 compare_supply 12", "refused: wrong_state").c_str());
  STRCMP_EQUAL("refused: not_lease_holder: another program commands this muscle",
               answer_with_reason(Reply(Refusal::not_lease_holder)).c_str());
}

TEST(RefusalWords, AnswersWithAReasonAreUnchanged) {
  for (const char* answer :
       {"ok", "refused: unsuitable: kind is unstable on this muscle",
        "refused: out_of_range; 0.025 would be obeyed", "refused: too many clients", "wrong: x"})
    STRCMP_EQUAL(answer, answer_with_reason("1 tune 0", answer).c_str());
}
