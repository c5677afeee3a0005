// One line of a flight recording.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "loop/snapshot.hpp"

namespace supercoil {

/// Bits of Row::flags.
enum RowFlag : std::uint8_t {
  row_probing = 1,
  row_trusted = 2,
  row_limited = 4,
  row_proof_off = 8,
  row_oscillated = 16,
  row_slack = 32
};

/// A snapshot in single precision. Written to recordings as it is in memory, little-endian; the
/// layout is a file format (docs/recorder.md) and must not change.
struct Row {
  std::int64_t time_ns;
  std::uint8_t channel;
  std::uint8_t state;
  std::uint8_t mode;
  std::uint8_t fault;
  std::uint8_t limited_by;
  std::uint8_t controller;
  std::uint8_t flags;            ///< of RowFlag
  std::uint8_t margin_selector;  ///< the fault whose margin this row carries
  float reference;               ///< m, or W in open loop
  float model_m;
  float position_m;
  float demanded_W;
  float applied_W;
  float duty;
  float supply_V;
  float current_A;
  float resistance_Ohm;
  float resistance_age_s;
  float coldest_C;
  float hottest_C;
  std::array<float, 4> theta;
  float error_bound;
  float progress;
  float margin_used;
  float margin_measured;
  float margin_limit;
  float gain;
  std::uint8_t gain_selector;  ///< which of the controller's gains this row carries
  std::uint8_t result;         ///< of ModeResult
  /// Each row carries one of the estimator's values beside theta, in turn.
  std::uint8_t multiplexed_selector;  ///< place in multiplexed_names
  std::uint8_t identify_notes;        ///< bits of IdentifyNote
  float multiplexed_value;
};
static_assert(sizeof(Row) == 112 && std::is_trivially_copyable_v<Row>);

/// In the layout of recordings.
Row row_of(const Snapshot& snapshot);

}  // namespace supercoil
