#include "apps/supercoil/setup/next_question.hpp"

#include <algorithm>

#include "config/toml_file.hpp"

namespace supercoil::operating {

namespace {

/// An unknown limit leaves the question's own limit.
void limit_max(double highest, Question& q) {
  if (highest >= q.allowed.min)
    q.allowed.max = std::min(q.allowed.max, rounded_down(highest, range_digits));
}

/// With neither this nor thread_g, nothing says how hot the muscle gets.
constexpr Question needed_heated_K{
    "heated_K",
    "How much warmer than the air was it with that power, by a thermometer, in K; needed, as "
    "thread_g is not known",
    {0.1, 200.0},
    NAN};

}  // namespace

BoardRanges board_ranges(const std::string& text, int channel) {
  const toml::table document = toml::parse(text);
  BoardRanges ranges;
  ranges.min_supply_V = document.at_path("supply.min_V").value_or(NAN);
  const std::string own = "channel[" + std::to_string(channel - 1) + "]";
  const double common_m = document.at_path("every_channel.position.max_m").value_or(NAN);
  ranges.max_position_m = document.at_path(own + ".position.max_m").value_or(common_m);
  return ranges;
}

Question next_question(std::size_t place, const MuscleAnswers& answers, const BoardRanges& board) {
  Question q = questions.at(place);
  switch (static_cast<QuestionId>(place)) {
    case QuestionId::heated_K:
      return answers.of(QuestionId::thread_g) > 0.0 ? q : needed_heated_K;
    case QuestionId::max_W:
      limit_max(
          board.min_supply_V * board.min_supply_V / answers.of(QuestionId::cold_resistance_Ohm), q);
      return q;
    case QuestionId::max_travel_mm:
      limit_max(1e3 * board.max_position_m, q);
      return q;
    default:
      return q;
  }
}

}  // namespace supercoil::operating
