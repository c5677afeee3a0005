// Whether the board still has the muscle that setup found.
#pragma once

#include <optional>
#include <string>

#include "apps/supercoil/setup/record.hpp"
#include "loop/known_muscle.hpp"

namespace supercoil::operating {

struct OtherMuscle {
  std::string step;    ///< from which on it is to be done anew
  std::string reason;  ///< in one line
};

/// calibrate or identify found something.
bool tells_of_muscle(const SetupRecord& record);

/// The first step whose figures are not the board's, beyond what floats on a bus and on a disk
/// round; empty: all are.
std::optional<OtherMuscle> other_muscle(const SetupRecord& record, const KnownMuscle& known);

}  // namespace supercoil::operating
