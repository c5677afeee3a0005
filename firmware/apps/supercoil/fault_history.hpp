// A fault's history from a flight recording, for text and JSON.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "recorder/recording.hpp"

namespace supercoil::operating {

/// More than one and a half periods between ticks: rows were lost, or ticks left out.
struct Gaps {
  std::int64_t count = 0;
  double max_s = 0.0;
  double max_from_s = 0.0;
};

/// A fault besides the one for which the recording was made.
struct OtherFault {
  std::optional<double> at_s;  ///< empty: it was there before the channel's first row
  int channel;                 ///< from 0
  std::uint8_t fault;          ///< 0: it was reset
};

/// What a channel did up to the fault, and its maxima over the whole recording.
struct ChannelHistory {
  const Row* last_before = nullptr;
  const Row* hottest = nullptr;
  double sum_W = 0.0;
  std::int64_t powers = 0;
  float max_W = 0.0F;
  std::map<int, const Row*> margins;  ///< the last of each detector, up to the fault

  void add(const Row& row, double time_s);
  double mean_W() const { return sum_W / static_cast<double>(powers); }
  /// The largest first.
  std::vector<const Row*> ranked_margins() const;
};

Gaps gaps_of(const recorder::Recording& recording);
std::vector<OtherFault> other_faults_of(const recorder::Recording& recording);
/// By channel, from 0. The histories point into the recording.
std::map<int, ChannelHistory> channels_of(const recorder::Recording& recording);

}  // namespace supercoil::operating
