// How identify and calibrate ended, in words: what programs and the page say of it, and
// docs/running.md too.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "modes/result.hpp"

namespace supercoil {

/// By their numbers: "the muscle did not cool within two minutes".
extern const std::array<std::string_view, mode_result_names.size()> result_words;

/// By the bits of IdentifyNote: "θ2 is uncertain".
extern const std::array<std::string_view, identify_note_names.size()> note_words;

/// "poor_fit: the muscle did not do what the fit predicted, ...; theta2_uncertain". Names are those
/// that a board tells, with commas between notes. What was found needs no explanation, and a note
/// of the result's own name says nothing new. cause: of what was interrupted, "by Ctrl-C"; empty:
/// not known.
std::string told_result(std::string_view result, std::string_view notes,
                        std::string_view cause = "");
std::string told_result(ModeResult result, std::uint8_t notes);

}  // namespace supercoil
