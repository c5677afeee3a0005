// A configuration as it was understood, in words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "config/board_config.hpp"
#include "loop/promise.hpp"

namespace supercoil::config {

/// What `supercoild --check` prints: the board, each channel, bus time, CAN, which detectors cannot
/// work and, last, memory, to which the daemon adds what only it knows.
std::string describe(const BoardConfig& config);

/// Its parts.
std::string describe_channel(const BoardConfig& config, std::size_t index);
/// index: into BoardSettings::joints.
std::string describe_joint(const BoardConfig& config, std::size_t index);
/// index: into BoardSettings::bundles.
std::string describe_bundle(const BoardConfig& config, std::size_t index);
/// One line about a channel whose joint is drawn back by a spring or a weight.
std::string describe_turned(const BoardConfig& config, std::size_t channel);
/// One line if that is a weight: the power that holding it takes, by the angle.
std::string describe_weight(const ChannelSettings& channel);
/// By how much all parameters may be off at once; NaN: the controller works in open loop.
double tolerated_ratio(const control::ControllerSettings& controller,
                       const ChannelSettings& channel, double step_s);
/// Bandwidth of a controller's feedback; NaN: it has no such setting.
double bandwidth_rad_per_s(const control::ControllerSettings& controller);
/// How far the sensor's noise makes a controller's power swing, rms; NaN: it works in open loop.
double noise_power_W(const control::ControllerSettings& controller, const ChannelSettings& channel,
                     double step_s);
/// A swing above this fraction of the power's range is reported: three deviations to both sides are
/// then more than half of the range.
inline constexpr double high_noise_ratio = 0.1;
/// What reduces the swing; never a bandwidth below the recommended one.
std::string noise_remedy(const control::ControllerSettings& controller,
                         const ChannelSettings& channel, const BoardSettings& board);
/// A controller's margin on the channel's muscle, how far the muscle's parameters may be off, and
/// its bandwidth; empty: it works in open loop.
std::string describe_margin(const control::ControllerSettings& controller,
                            const ChannelSettings& channel, double step_s);
/// What narrows the bounds of the muscle's heat, and what else would.
std::string describe_heat(const ChannelSettings& channel);
/// How far the true power may be from the measured one, and since which comparison with a meter.
std::string describe_senses(const ChannelSettings& channel, const BoardSettings& board);
/// How much of a small motion arrives at the sensor, and up to which power that is enough.
std::string describe_small_motions(const ChannelSettings& channel, const BoardSettings& board);
/// What the muscle can do with these limits: how far, how fast, from when on, how firmly each
/// controller holds it, and how closely it will follow. One line each: the same for `supercoild
/// --check`, `supercoil-sim run` and `supercoil setup`.
std::vector<std::string> describe_feasibility(const BoardSettings& board, std::size_t channel);
/// The error that each controller promises once the muscle is identified, or that the recommended
/// one would. Empty for a joint, where no error is known.
std::vector<std::string> describe_promises(const BoardSettings& board, std::size_t channel);
/// "14 um rms on a sine of 4 to 9 mm, period 6 s", and what contributes to it.
std::string describe_promise(const Promise& promise, const FirstMotion& motion);
/// The controller and the reference model that suit the channel's muscle, and why; which of the
/// channel's own controllers that is, or why it cannot have it. Empty if another channel leads it.
std::vector<std::string> describe_recommendation(const BoardSettings& board, std::size_t channel);
/// What to change so that a channel can do more, or does not fail; one line each, or none.
std::vector<std::string> advice(const ChannelSettings& channel, const BoardSettings& board);
/// Likewise, for a muscle that lifts an arm.
void advise_weight(const ChannelSettings& channel, std::vector<std::string>& lines);
/// Likewise, so that a joint's muscles last. index: into BoardSettings::joints.
std::vector<std::string> joint_advice(const BoardConfig& config, std::size_t index);
/// The same for every channel, each line with the channels that share it, and for every joint.
std::vector<std::string> advice(const BoardConfig& config);
/// One line for each detector that this configuration leaves blind: the channels, and why.
std::vector<std::string> warnings(const BoardConfig& config);

/// Bytes that are locked for a board's data: programs, libraries and stacks come on top.
struct Memory {
  std::size_t ring = 0;      ///< of the loop: rows that wait for the recorder
  std::size_t recorder = 0;  ///< the flight recorder's rows
  std::size_t loop = 0;      ///< the loop with its channels, controllers and estimators
  std::size_t total() const { return ring + recorder + loop; }
};
/// By the sizes of the types and the number of channels; nothing is allocated.
Memory memory_of(const BoardSettings& settings);

/// "GPIO17 of pinctrl-bcm2711".
std::string shown(const LineAddress& line);
/// "voltage0 of ads1115, buffered on i2c-1".
std::string shown(const ConverterAddress& converter);

}  // namespace supercoil::config
