#include "apps/supercoil/change_tuning.hpp"

#include <cmath>

#include "apps/supercoil/tuned_place.hpp"
#include "text/command_text.hpp"
#include "text/nearest.hpp"
#include "text/number_text.hpp"
#include "text/refusal_words.hpp"

namespace supercoil::operating {

namespace {

constexpr int all_digits = 17;

TuningDone done_or_why(const std::string& what, const BoardLink::Answer& answer) {
  if (!answer) return tl::unexpected(answer.error());
  if (*answer == "ok") return {};
  return failure(what + ": " + answer_with_reason(what, *answer));
}

/// Why a value was refused without a nearest one: the kind does not have it, as far as the board
/// tells. Empty: another reason.
std::string why_not(BoardLink& board, const std::string& channel, int place,
                    const TuningChange& change) {
  const ReadTunable read_value = tunable_reader(board, channel);
  constexpr std::size_t kind = 0;
  const auto value = read_value(place, change.tunable, TuningSet::prepared);
  const auto kind_value = read_value(place, kind, TuningSet::prepared);
  const auto names = read_names(place, read_value);
  if (!value || !std::isnan(*value) || !kind_value || !names || names->empty()) return "";
  return tuning_text(tuned_at(place), control::tunables()[kind], *kind_value) + " has no " +
         std::string(control::tunables()[change.tunable].name) + "; it has " + joined(*names);
}

}  // namespace

TuningDone prepare_tuning(BoardLink& board, const std::string& channel, int place,
                          const std::string& from, const std::vector<TuningChange>& changes) {
  if (auto begun = done_or_why("nothing was prepared", board.prepare(channel, place, "all", from));
      !begun)
    return begun;
  for (const TuningChange& one : changes) {
    const std::string name(control::tunables()[one.tunable].name);
    const std::string value = number_text(one.value, all_digits);
    const auto answer = board.prepare(channel, place, name, value);
    if (answer && *answer == answer_text(Refusal::out_of_range, NAN)) {
      if (const std::string why = why_not(board, channel, place, one); !why.empty())
        return failure(why);
    }
    if (auto done = done_or_why(std::string(name).append(" = ").append(value), answer); !done)
      return done;
  }
  return {};
}

TuningDone send_tuning_command(BoardLink& board, const std::string& line) {
  return done_or_why(line, board.ask(line));
}

}  // namespace supercoil::operating
