// Why a board refused, in words: what its answers mean to a person.
#pragma once

#include <string>
#include <string_view>

#include "loop/command.hpp"

namespace supercoil {

/// "it has no fault". verb: what was refused, where that is known. Empty: it was not refused.
std::string_view refusal_words(Refusal refusal, Verb verb = Verb::none);

/// answer_text() with the words behind it: "refused: wrong_state: it has no fault". A nearest value
/// says enough by itself.
std::string told_answer(const Reply& reply, Verb verb = Verb::none);

/// The same of an answer as text to a line, "1 arm"; what has a reason already stays, and so does
/// what is no answer of a board.
std::string told_answer(std::string_view line, std::string_view answer);

}  // namespace supercoil
