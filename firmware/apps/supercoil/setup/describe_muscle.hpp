// From what a person knows of a muscle to what a board's file says of it.
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
  std::optional<std::size_t> joint{};  ///< of which it is, from 0; empty: of the channel

  /// As somebody is told it: "limits.max_W", "joint.range_deg".
  std::string key() const { return (joint ? "joint." : "") + path; }
};

struct MuscleDescription {
  control::PhysicalParameters muscle;
  std::vector<Entry> entries;
};

/// Every question without a fallback must be answered. Each parameter follows from two or three
/// answers; its bounds follow from how wrong those may be, all of them to the same side. The error
/// says which answers contradict each other, or what no muscle of thread has. time: of the board's
/// loop.
Result<MuscleDescription> describe_muscle(const MuscleAnswers& answers,
                                          const config::LoopTime& time = {});

}  // namespace supercoil::operating
