// How identify and calibrate end.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace supercoil {

/// Of the last time that either was asked for. All but found and not_stored changes nothing.
enum class ModeResult : std::uint8_t {
  none = 0,           ///< never, since the start
  running = 1,        ///< it has not ended yet
  found = 2,          ///< used from now on, and handed to whoever stores it
  interrupted = 3,    ///< by a command or a fault
  not_cold = 4,       ///< calibrate: the muscle did not cool in time
  moved = 5,          ///< calibrate: the position changed while its zero was taken
  not_explained = 6,  ///< identify: the muscle did not do what the fit foretold
  uncertain = 7,      ///< identify: the fit's bound is too wide
  implausible = 8,    ///< out of range; of identify also: far from what was believed
  not_stored = 9,     ///< used, but the last ones still wait to be stored
};

inline constexpr std::array<std::string_view, 10> mode_result_names{
    "none",  "running",       "found",     "interrupted", "not_cold",
    "moved", "not_explained", "uncertain", "implausible", "not_stored"};

}  // namespace supercoil
