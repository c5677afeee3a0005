// A simulation run as its author wrote it, checked and complete.
#pragma once

#include <array>
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
  bool new_controller;    ///< the event names [controller]: it restarts with the new settings
  bool new_estimator;     ///< likewise [estimator]
  bool reset;             ///< the operator resets a fault and arms again, if possible
  std::string changes{};  ///< its keys: "plant.load_N, power.gain"
};

/// What a channel knew of its muscle before it started.
struct KnownBefore {
  bool muscle_identified = false;  ///< not only believed
  double response_ratio = 0.0;     ///< of small motions
  double unexplained_ratio = 0.0;  ///< by the linear model
  board::Identification identification{};
  board::Calibration calibration;  ///< its resistance is the plant's unless learned
};

/// In a scenario.
inline constexpr std::size_t max_muscles = 8;

/// What a board learned before: about its muscle, a joint's agonist and antagonist, or a bundle's
/// muscles.
using LearnedMuscles = std::array<std::optional<board::Learned>, max_muscles>;

struct Scenario {
  std::string name;
  std::uint32_t crc32 = 0;  ///< of the content, without comments and order of keys
  double duration_s = 200.0;
  double rate_Hz = 1000.0;
  std::uint64_t seed = 1;
  int substeps = 1;
  std::array<KnownBefore, max_muscles> known;  ///< in the order of LearnedMuscles
  /// The firmware of the user's own board, with one channel, joint or bundle; empty: one is made
  /// for the scenario.
  std::optional<BoardSettings> board;
  std::uint32_t board_crc32 = 0;  ///< of its file's content
  telemetry::CanSettings can;
  Conditions start;
  std::vector<Event> events;  ///< in the order of their times

  double step_s() const { return 1.0 / rate_Hz; }
  /// Channels of its board, each a node; a joint of two muscles has two.
  int channels() const {
    return start.antagonist() != nullptr ? 2 : 1 + static_cast<int>(start.companions.size());
  }
  /// Number of ticks, the one at time 0 included, the one at duration_s not.
  std::int64_t ticks() const { return std::llround(duration_s * rate_Hz); }
};

}  // namespace supercoil::host_sim
