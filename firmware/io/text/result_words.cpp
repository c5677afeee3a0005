#include "text/result_words.hpp"

#include <algorithm>
#include <cstddef>

#include "text/documentation.hpp"

namespace supercoil {

const std::array<std::string_view, mode_result_names.size()> result_words{
    "not run since the start",
    "it has not ended yet",
    "used from now on, and stored",
    "ended by a command or a fault",
    "the muscle did not cool within two minutes",
    "the position changed by more than 0.1 mm while its zero was taken",
    "the muscle did not move as the fit predicted, even in shorter strokes: play, a changing load "
    "or a slipping sensor",
    "θ3 or θ4, which controllers need, is not known well enough, or θ2 is hardly known: the sensor "
    "is too noisy for this motion",
    "the result is out of range or, for identify, far from the configured muscle",
    "used from now on, but not stored: earlier results still wait for the disk",
    "the muscle moved by less than 1 % of its travel at the maximum power",
    "the muscle moved the wrong way when it was heated: the sensor's sign is wrong or, in a joint, "
    "the two heaters are swapped"};

const std::array<std::string_view, identify_note_names.size()> note_words{
    "θ1 was not known well enough: the believed one is kept, in proportion to θ3",
    "θ2 is uncertain",
    "θ3 is uncertain",
    "θ4 is uncertain",
    "the model does not explain full strokes",
    "implausible",
    "too little motion",
    "friction takes more than half of a small motion, so less power may be allowed"};

std::string result_text(std::string_view result, std::string_view notes, std::string_view cause) {
  std::string text(result);
  const auto* const found = std::ranges::find(mode_result_names, result);
  const bool has_words =
      found != mode_result_names.end() &&
      *found != mode_result_names.at(static_cast<std::size_t>(ModeResult::found));
  if (!cause.empty()) {
    text += ", ";
    text += cause;
  } else if (has_words) {
    text += ": ";
    text += result_words.at(static_cast<std::size_t>(found - mode_result_names.begin()));
  }
  std::string others;
  while (!notes.empty()) {
    const std::string_view note = notes.substr(0, notes.find(','));
    notes.remove_prefix(std::min(note.size() + 1, notes.size()));
    if (note == result) continue;
    others += others.empty() ? "; " : ", ";
    others += note;
  }
  return text + others;
}

std::string result_text(ModeResult result, std::uint8_t notes) {
  return result_text(mode_result_names.at(static_cast<std::size_t>(result)),
                     describe_notes(notes, ","));
}

std::string result_remedy() {
  return "; for what to do see " + documentation_page("troubleshooting");
}

}  // namespace supercoil
