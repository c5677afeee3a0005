// Derives a board file's entries from what a person knows of a muscle.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/hal/error.hpp"

#include "apps/supercoil/setup/muscle_answers.hpp"
#include "config/recommended_controller.hpp"

namespace supercoil::operating {

/// One key of a [[channel]], or of a [[joint]], as config::with_value takes it.
struct Entry {
  std::string path;
  std::string literal;
  std::string reason;                  ///< how it follows from the answers
  std::optional<std::size_t> joint{};  ///< its joint, from 0; empty: the channel

  /// As shown to a person: "limits.max_W", "joint.range_deg".
  std::string key() const { return (joint ? "joint." : "") + path; }
};

struct MuscleDescription {
  control::PhysicalParameters muscle;
  std::vector<Entry> entries;
};

/// Every question without a fallback must be answered. Each parameter is derived from two or three
/// answers; its bounds assume that all of these are wrong to the same side. The error says which
/// answers contradict each other, or what no muscle of thread can have. time: of the board's loop.
Result<MuscleDescription> describe_muscle(const MuscleAnswers& answers,
                                          const config::LoopTime& time = {});

}  // namespace supercoil::operating
