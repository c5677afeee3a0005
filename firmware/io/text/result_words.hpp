// How identify and calibrate ended, in words, for programs, the page and docs/running.md.
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

/// "poor_fit: the muscle did not move as the fit predicted, ...; theta2_uncertain". Names are as
/// the board reports them, with commas between notes. Success needs no explanation, and a note with
/// the result's own name is left out. cause: of an interruption, "by Ctrl-C"; empty: not known.
std::string result_text(std::string_view result, std::string_view notes,
                        std::string_view cause = "");
/// The same for a result and notes as the board's rows carry them.
std::string result_text(ModeResult result, std::uint8_t notes);
/// After a bad end: "; for what to do see ...".
std::string result_remedy();

}  // namespace supercoil
