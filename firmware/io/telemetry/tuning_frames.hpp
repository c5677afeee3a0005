// How the controllers of a running board are tuned over CAN.
#pragma once

#include "loop/loop.hpp"
#include "telemetry/leases.hpp"
#include "telemetry/run_settings.hpp"

namespace supercoil::telemetry {

/// In TuningWrite: the whole prepared set instead of one value.
inline constexpr std::uint8_t all_tunables = 255;

/// The number that the sender converted to this float: the shortest decimal that gives it.
double shortest_decimal(float value);

/// Neither sends nor receives. A write prepares a value, and needs the channel's lease; a read does
/// not. Verb::tune takes the prepared values into use.
class TuningFrames {
 public:
  /// leases and loop must outlive it. first_node: that of the board's first channel.
  TuningFrames(can::Node first_node, Leases& leases, Loop& loop)
      : first_node_(first_node), leases_(&leases), loop_(&loop) {}

  /// Any frame of the bus, in the order received.
  TakenWrite take(const hal::CanFrame& frame, hal::Time now);

 private:
  TakenWrite take_write(std::uint8_t channel, const hal::CanFrame& frame, hal::Time now);
  Reply prepare(std::uint8_t channel, std::uint8_t place, std::uint8_t tunable, float value);
  hal::CanFrame tuning_frame(std::uint8_t channel, TuningSet set, std::uint8_t place,
                             std::uint8_t tunable, Refusal refusal, std::uint8_t counter) const;

  can::Node first_node_;
  Leases* leases_;
  Loop* loop_;
};

}  // namespace supercoil::telemetry
