// How identify and calibrate end.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace supercoil {

/// Result of the last request for either. Only found and not_stored change anything.
enum class ModeResult : std::uint8_t {
  none = 0,                ///< none requested since the start
  running = 1,             ///< it has not ended yet
  found = 2,               ///< used from now on, and handed to the storage worker
  interrupted = 3,         ///< by a command or a fault
  not_cold = 4,            ///< calibrate: the muscle did not cool in time
  moved = 5,               ///< calibrate: the position changed while its zero was taken
  poor_fit = 6,            ///< identify: the muscle did not do what the fit predicted
  uncertain = 7,           ///< identify: a parameter that a controller needs is uncertain
  implausible = 8,         ///< out of range; for identify also: far from what was believed
  not_stored = 9,          ///< used, but earlier results still wait to be stored
  too_little_motion = 10,  ///< identify: the muscle hardly moved
  moved_backwards = 11,    ///< identify: heat moved it away from where it should
};

inline constexpr std::array<std::string_view, 12> mode_result_names{
    "none",     "running",   "found",       "interrupted", "not_cold",          "moved",
    "poor_fit", "uncertain", "implausible", "not_stored",  "too_little_motion", "moved_backwards"};

/// Bits: identify's notes on its last fit. Each is a reason to refuse it, except theta1_kept and
/// friction, theta2_uncertain unless θ2 is hardly known at all, and poor_fit if shorter strokes
/// found the muscle.
enum IdentifyNote : std::uint8_t {
  note_theta1_kept = 1,       ///< not known well enough: the believed one is kept
  note_theta2_uncertain = 2,  ///< its deviation is too large, or the unseen third disagrees
  note_theta3_uncertain = 4,
  note_theta4_uncertain = 8,
  note_poor_fit = 16,
  note_implausible = 32,
  note_too_little_motion = 64,
  note_friction = 128,  ///< less than half of a small motion arrives at the sensor
};
inline constexpr std::array<std::string_view, 8> identify_note_names{
    "theta1_kept", "theta2_uncertain", "theta3_uncertain",  "theta4_uncertain",
    "poor_fit",    "implausible",      "too_little_motion", "friction"};

/// "theta2_uncertain, poor_fit"; empty when there is none. A bit without a name is left out.
inline std::string describe_notes(std::uint8_t notes, const std::string& separator = ", ") {
  std::string text;
  for (std::size_t i = 0; i < identify_note_names.size(); ++i) {
    if ((notes >> i & 1U) == 0) continue;
    text += (text.empty() ? "" : separator) + std::string(identify_note_names[i]);
  }
  return text;
}

}  // namespace supercoil
