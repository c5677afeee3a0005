// What may be changed on a running board over CAN, until it starts again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "loop/loop.hpp"
#include "telemetry/leases.hpp"
#include "telemetry/publisher.hpp"

namespace supercoil::telemetry {

/// 0: a channel's max power in W, up to the configured maximum. Then the rate in Hz of each message
/// of its node, in the order of Message; that of Joint is fixed by the file. The last three can
/// only be read: the result of comparing the channel's senses with a meter.
enum SenseSetting : std::uint8_t {
  supply_gain = 1 + static_cast<std::uint8_t>(Message::joint),
  current_gain,
  sense_error
};
inline constexpr std::uint8_t run_settings = sense_error + 1;
static_assert(run_settings <= 16, "a setting has 4 bits");
/// As in the DBC, with its unit.
std::string run_setting_name(std::uint8_t setting);

/// The result of a frame that may write something. All empty: the frame is not of this kind.
struct TakenWrite {
  std::optional<std::uint8_t> damaged;  ///< the channel whose write was damaged
  std::optional<hal::CanFrame> answer;
  std::optional<hal::CanFrame> refused_value;  ///< sent after the answer
};

/// Neither sends nor receives. Writing needs the channel's lease, as a command does; reading does
/// not. Every intact frame is answered with the value that holds from then on.
class RunSettings {
 public:
  /// board: the settings that the loop was made with. All others must outlive it.
  RunSettings(CanSettings can, const BoardSettings& board, Leases& leases, Publisher& publisher,
              Loop& loop);

  /// Any frame of the bus, in the order received.
  TakenWrite take(const hal::CanFrame& frame, hal::Time now);

 private:
  TakenWrite take_write(std::uint8_t channel, const hal::CanFrame& frame, hal::Time now);
  Refusal set(std::uint8_t channel, std::uint8_t setting, double value);
  Refusal set_rate(std::uint8_t channel, Message message, double rate_Hz);
  /// NaN: the channel has no such setting.
  double value_of(std::uint8_t channel, std::uint8_t setting) const;
  /// The allowed value of a setting that is nearest to this one. NaN: not known.
  double nearest(std::uint8_t channel, std::uint8_t setting, double value) const;
  hal::CanFrame setting_frame(std::uint8_t channel, std::uint8_t setting, Refusal refusal,
                              std::uint8_t counter, std::uint16_t session) const;

  CanSettings can_;
  double tick_Hz_;
  std::vector<double> max_W_;  ///< configured, of each channel
  Leases* leases_;
  Publisher* publisher_;
  Loop* loop_;
};

}  // namespace supercoil::telemetry
