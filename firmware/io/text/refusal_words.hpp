// Why a board refused, in words: what its answers mean to a person.
#pragma once

#include <string>
#include <string_view>

#include "loop/command.hpp"

namespace supercoil {

/// "it has no fault". verb: what was refused, if known. Empty: it was not refused.
std::string_view refusal_words(Refusal refusal, Verb verb = Verb::none);

/// answer_text() followed by the words: "refused: wrong_state: it has no fault". An answer with a
/// nearest value gets no words.
std::string answer_with_reason(const Reply& reply, Verb verb = Verb::none);

/// The same for the text of an answer to a line such as "1 arm". Returns the text unchanged if it
/// already has a reason or is not a board's answer.
std::string answer_with_reason(std::string_view line, std::string_view answer);

}  // namespace supercoil
