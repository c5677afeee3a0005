// What the firmware knows, as frames of the CAN protocol (supercoil.dbc).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/hal/can_bus.hpp"

#include "can/nodes.hpp"
#include "loop/row.hpp"

namespace supercoil::telemetry {

/// Messages that are sent at a rate of their own.
enum class Message : std::uint8_t {
  measurement,
  tracking,
  power,
  heater,
  temperature,
  estimate,
  margin,
  limit,
  timing,
  status,
  gain,
  joint,  ///< sent by the node of a joint only
};
inline constexpr std::size_t messages = 12;

/// A message that has a rate.
struct PeriodicMessage {
  std::string_view name;  ///< as in configurations
  const can::MessageInfo* info;
  bool of_board = false;  ///< sent by the board's first node only

  double default_Hz() const { return 1000.0 / info->period_ms; }
};
/// In the order of Message.
const std::array<PeriodicMessage, messages>& periodic_messages();

/// Tick times of a whole board, as Timing carries them. NaN: there was no tick.
struct BoardTiming {
  double late_s = NAN;
  double execution_s = NAN;
  std::uint32_t overruns = 0;
  std::uint32_t dropped_frames = 0;
};

hal::CanFrame emergency(can::Node node, const Row& row);
/// From the row that first shows a fault.
hal::CanFrame first_cause(can::Node node, const Row& row);
/// Sent right after the answer that refuses the value as out of range. nearest: as in Answer.
hal::CanFrame refused_value(can::Node node, double value, double nearest);
hal::CanFrame measurement(can::Node node, const Row& row);
hal::CanFrame tracking(can::Node node, const Row& row);
hal::CanFrame power(can::Node node, const Row& row);
hal::CanFrame heater(can::Node node, const Row& row);
hal::CanFrame temperature(can::Node node, const Row& row);
/// The newest of each value that is multiplexed in rows.
class MultiplexedValues {
 public:
  MultiplexedValues() { newest_.fill(NAN); }
  /// The next row of the channel. A row without a value, from an estimator that gives none, clears
  /// all.
  void take(const Row& row);
  /// place: in multiplexed_names, from 1. NaN: no value yet.
  float of(std::size_t place) const { return newest_.at(place - 1); }
  /// How many parameters have a value, counted from 0 as in the DBC. The multiplexed ones are the
  /// last ones; they count when all of them have a value.
  std::uint8_t parameters() const;

 private:
  std::array<float, multiplexed_names.size() - 1> newest_{};
};
/// parameter: from 0, as in the DBC. known: what theta leaves open in the physical parameters. Not
/// available: theta is not physical, or no row has carried the value yet.
hal::CanFrame estimate(can::Node node, const Row& row, std::uint8_t parameter,
                       const control::KnownParameters& known,
                       const MultiplexedValues& multiplexed = {});
hal::CanFrame margin(can::Node node, const Row& row);
hal::CanFrame limit(can::Node node, const Row& row);
hal::CanFrame gain(can::Node node, const Row& row);
hal::CanFrame timing(can::Node node, const BoardTiming& timing);
/// The heartbeat. leased: a master holds the channel's lease. counter: of the heartbeats, 0 to 255.
hal::CanFrame status(can::Node node, const Row& row, bool leased, std::uint8_t counter);
/// version: as from program_version(). A part of it that is not a number becomes 0.
hal::CanFrame boot(can::Node node, std::string_view version);

}  // namespace supercoil::telemetry
