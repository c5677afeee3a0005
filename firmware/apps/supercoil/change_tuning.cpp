#include "apps/supercoil/change_tuning.hpp"

#include "text/number_text.hpp"
#include "text/refusal_words.hpp"

namespace supercoil::operating {

namespace {

constexpr int all_digits = 17;

TuningDone done_or_why(const std::string& what, const BoardLink::Answer& answer) {
  if (!answer) return tl::unexpected(answer.error());
  if (*answer == "ok") return {};
  return tl::unexpected(what + ": " + told_answer(what, *answer));
}

}  // namespace

TuningDone prepare_tuning(BoardLink& board, const std::string& channel, int place,
                          const std::string& from, const std::vector<TuningChange>& changes) {
  const auto prepare = [&](const std::string& name, const std::string& value) {
    return done_or_why(name + " = " + value, board.prepare(channel, place, name, value));
  };
  if (auto begun = prepare("all", from); !begun) return begun;
  for (const TuningChange& one : changes) {
    const std::string name(control::tunables()[one.tunable].name);
    if (auto done = prepare(name, number_text(one.value, all_digits)); !done) return done;
  }
  return {};
}

TuningDone ask_for_tuning(BoardLink& board, const std::string& line) {
  return done_or_why(line, board.ask(line));
}

}  // namespace supercoil::operating
