// Commands as a person or a script writes them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

#include "loop/command.hpp"

namespace supercoil {

/// "1 position 0.01": a channel from 1, a verb, and a value where the verb has one, in SI units.
/// channels: how many the board has. addressed: what an error calls the first number; a master on a
/// bus addresses nodes. The error says what is wrong and what is allowed.
Result<Command> parse_command(std::string_view text, std::size_t channels,
                              std::string_view addressed = "channel");

/// A channel as it is written, from 1; the result is counted from 0.
Result<std::uint8_t> parse_channel(std::string_view word, std::size_t channels,
                                   std::string_view addressed = "channel");

/// Why a command with this value is not sent, e.g. a negative power, which no heater can give;
/// empty: it is.
std::string value_problem(Verb verb, double value);

/// "1 knot 0.02 0.01 0.001": s after the previous knot, m, m/s; "1 start 12.345": at this time of
/// the board's clock, in s. Empty: the text is neither.
std::optional<Result<Command>> parse_trajectory_command(std::string_view text,
                                                        std::size_t channels);

/// Describes the number after a verb: "a number, in m". Empty: the verb takes none.
std::string_view needed_value(Verb verb);

/// "ok", "refused: wrong_state", or "refused: out_of_range; 0.025 would be obeyed". nearest: as in
/// Answer.
std::string answer_text(Refusal refusal, double nearest);

/// Parses the text of answer_text(), also with a reason after it. Empty: not such an answer.
std::optional<Reply> parse_answer(std::string_view text);
/// Whether the text is an answer that refuses for this reason.
bool refuses(std::string_view text, Refusal why);

}  // namespace supercoil
