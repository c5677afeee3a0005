// Whether the board still has the muscle that setup found.
#pragma once

#include <optional>
#include <string>

#include "apps/supercoil/setup/record.hpp"
#include "loop/known_muscle.hpp"

namespace supercoil::operating {

struct OtherMuscle {
  std::string step;    ///< the first step to repeat
  std::string reason;  ///< in one line
};

/// Whether calibrate or identify found something.
bool has_muscle_findings(const SetupRecord& record);

/// The first step whose figures differ from the board's by more than the rounding of floats on bus
/// and disk; empty: none.
std::optional<OtherMuscle> other_muscle(const SetupRecord& record, const KnownMuscle& known);

}  // namespace supercoil::operating
