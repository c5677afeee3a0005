// Leads a person with a meter through the comparison that the running firmware makes. The firmware
// contains all protection; this only asks.
#pragma once

#include <string>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/setup/operator.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

struct ComparisonPlan {
  std::string channel;  ///< as in a line of a command
  double power_W = 0.0;
  config::Range supply_V{0.0, 60.0};
};

/// Plans with the steady power at which full power stays allowed in the warmest air, even if the
/// muscle were cooled by a quarter of the configured min and the senses had the largest unnoticed
/// errors.
ComparisonPlan plan_comparison(std::string channel, ChannelSettings settings,
                               const BoardSettings& board);

/// What it will do, and for how long; shown before it heats.
std::string describe_plan(const ComparisonPlan& plan);

/// Arms the channel, heats it with half of that power and then all of it, and asks two questions at
/// each; always disarms it at the end. The error: why it ended.
Result<board::SenseComparison> compare_senses(BoardLink& board, const ComparisonPlan& plan,
                                              Operator& user);

/// "true over measured: supply 1, current 0.98; 2 % may remain of each"
std::string describe_comparison(const board::SenseComparison& found);
/// "the true power is 0.97 to 1.03 times the measured power; …"
std::string power_bounds_text(ChannelSettings settings, const BoardSettings& board,
                              const board::SenseComparison& senses);

}  // namespace supercoil::operating
