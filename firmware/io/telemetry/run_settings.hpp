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

/// 0: the power that a channel gets at most, in W, up to the configured maximum. The others: how
/// often each message of its node is sent, in Hz, in the order of Message; that of Joint is the
/// file's. The last three are only read: what the channel's senses were found to be by a comparison
/// with a meter.
enum SenseSetting : std::uint8_t {
  supply_gain = 1 + static_cast<std::uint8_t>(Message::joint),
  current_gain,
  sense_error
};
inline constexpr std::uint8_t run_settings = sense_error + 1;
static_assert(run_settings <= 16, "a setting has 4 bits");
/// As in the DBC, with its unit.
std::string run_setting_name(std::uint8_t setting);

/// What became of a frame that may write something. All empty: it has nothing to do with it.
struct TakenWrite {
  std::optional<std::uint8_t> damaged;  ///< the channel whose write was damaged
  std::optional<hal::CanFrame> answer;
  std::optional<hal::CanFrame> refused_value;  ///< goes after the answer
};

/// Neither sends nor receives. Writing needs the channel's lease, as a command does; reading does
/// not. Whatever came whole is answered with what holds from then on.
class RunSettings {
 public:
  /// board: as the loop was made with. All others outlive it.
  RunSettings(CanSettings can, const BoardSettings& board, Leases& leases, Publisher& publisher,
              Loop& loop);

  TakenWrite take(const hal::CanFrame& frame, hal::Time now);

 private:
  TakenWrite take_write(std::uint8_t channel, const hal::CanFrame& frame, hal::Time now);
  Refusal set(std::uint8_t channel, std::uint8_t setting, double value);
  Refusal set_rate(std::uint8_t channel, Message message, double rate_Hz);
  /// NaN: there is no such setting of this channel.
  double value_of(std::uint8_t channel, std::uint8_t setting) const;
  /// Of the values of a setting that may be written, to this one. NaN: none is known.
  double nearest(std::uint8_t channel, std::uint8_t setting, double value) const;
  hal::CanFrame told(std::uint8_t channel, std::uint8_t setting, Refusal refusal,
                     std::uint8_t counter, std::uint16_t session) const;

  CanSettings can_;
  double tick_Hz_;
  std::vector<double> max_W_;  ///< configured, of each channel
  Leases* leases_;
  Publisher* publisher_;
  Loop* loop_;
};

}  // namespace supercoil::telemetry
