// A simulation run as its author wrote it, checked and complete.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "board/learned.hpp"
#include "loop/settings.hpp"
#include "scenario/conditions.hpp"
#include "telemetry/settings.hpp"

namespace supercoil::host_sim {

/// From at_s on, the scenario runs under other conditions.
struct Event {
  double at_s;
  Conditions conditions;
  bool new_controller;  ///< the event names [controller]: it starts anew with the new settings
  bool new_estimator;   ///< likewise [estimator]
  bool reset;           ///< the operator resets a fault and arms again, where it is possible
};

struct Scenario {
  std::string name;
  std::uint32_t crc32 = 0;  ///< of what is written, without comments and order of keys
  double duration_s = 200.0;
  double rate_Hz = 1000.0;
  std::uint64_t seed = 1;
  int substeps = 1;
  bool muscle_identified = false;  ///< identified before: not only believed
  double response_ratio = 0.0;     ///< of small motions, learned before
  board::Calibration calibration;  ///< learned before; its resistance is [plant]'s otherwise
  /// The firmware of a board of the user's own, with one channel or one
  /// joint; empty: one for the scenario.
  std::optional<BoardSettings> board;
  telemetry::CanSettings can;
  Conditions start;
  std::vector<Event> events;  ///< in the order of their times

  double step_s() const { return 1.0 / rate_Hz; }
  /// Of its board, each a node: two of a joint of two muscles.
  int channels() const { return start.antagonist() != nullptr ? 2 : 1; }
  /// Number of ticks, the one at time 0 included, the one at duration_s not.
  std::int64_t ticks() const { return std::llround(duration_s * rate_Hz); }
};

}  // namespace supercoil::host_sim
