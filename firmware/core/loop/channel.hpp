// One muscle's channel: its state, its supervisor, and the stages of its tick in their order.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "loop/axis.hpp"
#include "loop/command.hpp"
#include "loop/settings.hpp"
#include "loop/snapshot.hpp"
#include "loop/tuner.hpp"
#include "supervisor/channel_supervisor.hpp"

namespace supercoil {

/// What the board passes to its channels in a tick.
struct BoardTick {
  hal::Time time{};
  double supply_V = 0.0;
  Fault fault = Fault::none;  ///< of the board, latched or present: every channel is made safe
  detectors::Margin margin;   ///< of that fault; channels report faults of the bus with it too
  bool testing = true;        ///< the self-test runs: nothing is latched
  bool proven = false;        ///< it has passed: both ways of cutting the heat work
  std::int64_t periods = 1;   ///< since the last tick
  const board::Measured* air = nullptr;  ///< in °C; null: no sensor
};

/// Axis, supervisor and commands of one muscle. The board's loop calls it in its own thread; what
/// other threads may call says so.
class Channel {
 public:
  /// index: from 0. Devices outlive the channel. Allocates; ticks do not.
  Channel(const ChannelSettings& settings, const BoardSettings& board,
          const board::ChannelDevices& devices, std::uint8_t index);
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  // Before the first tick, for channels that exist as long as this one:
  /// Both are in a joint. Position commands go to this channel.
  void lead_joint(Channel& antagonist);
  /// They form a bundle, and all commands go to this channel.
  void lead_bundle(std::vector<Channel*> followers);
  Axis& axis() { return axis_; }

  // The stages of a tick, in this order.
  /// Takes the newest readings, and forgets the reset command of the last tick.
  void sample(hal::Time now);
  /// Obeys or refuses a command. The supervisor counts those that the channel's state refuses.
  Reply answer(const Command& command, const BoardTick& board);
  /// Runs every detector, once for each period that passed. A fault of the channel or of the board
  /// makes the channel safe here, before any new power is set.
  void supervise(const BoardTick& board);
  void estimate() { axis_.estimate(); }
  void control();
  /// In a joint or bundle, Joint::limit() or Bundle::limit() does this.
  void limit() { axis_.limit(axis_.demanded_W()); }
  void drive() { axis_.drive(); }
  /// The tick's snapshot. board_verdict: for the margins of the board's own detectors.
  const Snapshot& publish(const BoardTick& board, const Verdict& board_verdict);

  /// The only way to make the channel safe, with all others of its joint or bundle: duty 0 and
  /// enable low, at once. Fault::none is an ordinary stop.
  void disarm(Fault cause, const detectors::Margin& margin = {});
  /// For the self-test: sets duty and enable line directly. Only while disarmed.
  void test_drive(double duty, bool enable) { axis_.heater().test_drive(duty, enable); }
  double measured_current_A() const {
    const board::Measured& current = axis_.heater().current();
    return current.present ? current.value : INFINITY;
  }
  /// A command arrived damaged and was not obeyed.
  void note_damaged() { commands_.damaged = true; }

  const ChannelState& state() const { return state_; }
  const Snapshot& snapshot() const { return snapshot_; }
  const Verdict& verdict() const { return supervisor_.verdict(); }
  /// The margin of the detector that led to `fault`, at that time.
  const detectors::Margin& first_margin() const { return first_margin_; }
  /// The fault of the whole board that this channel's detectors see now, if any.
  Fault present_board_fault() const { return supervisor_.verdict().board_fault(); }
  /// The fault that a detector sees now, latched or not.
  Fault present_fault() const { return present_fault_; }
  /// Of the muscle as now known; between ticks only.
  double dc_gain_m_per_W() const { return axis_.dc_gain_m_per_W(); }
  const std::optional<control::Estimate>& estimates() const {
    return axis_.estimation().estimate();
  }
  bool lines_ok() const { return axis_.heater().lines_ok(); }
  /// Between ticks only: sets the limiter's range.
  void set_power_range(double min_W, double max_W) {
    axis_.heater().set_power_range(min_W, max_W);
    allow_power(max_W);
  }
  /// From one other thread: limits the power, from the next tick on, to max_W and the configured
  /// maximum. max_W: at least 0.
  void allow_power(double max_W) { axis_.heater().allow_power(max_W); }
  double max_power_W() const { return axis_.heater().max_power_W(); }
  /// The comparison that corrects the readings, without its date; from any thread.
  board::SenseComparison senses() const { return axis_.heater().published_senses(); }
  /// A value of its muscle, by its place in known_quantities; NaN: not known. From any thread.
  double known(std::size_t quantity) const { return axis_.published_muscle(quantity); }
  /// Of the trajectory; from any thread.
  PlaybackStatus playback() const { return axis_.playback(); }
  /// As Playback::align; from one other thread.
  void align_playback(double ahead_s) { axis_.align_playback(ahead_s); }
  /// For is_tuning() commands. Called, like all of the tuner, in the thread that sends commands.
  void add_tuning(Command& command);
  Tuner& tuner() { return tuner_; }
  const Tuner& tuner() const { return tuner_; }
  /// What identify or calibrate found, or a command to store or clear; from one other thread.
  bool take_learned_update(board::LearnedUpdate& update) {
    return axis_.take_learned_update(update);
  }

 private:
  Reply obey(const Command& command, const BoardTick& board);
  void make_safe(Fault cause, const detectors::Margin& margin);
  Refusal may_arm(const BoardTick& board) const;
  Refusal arm(const BoardTick& board);
  void arm_now();
  Refusal reset(const BoardTick& board);
  Refusal may_heat(const BoardTick& board) const;
  Reply heat(Mode mode, double value, const BoardTick& board);
  void enter(Mode mode, double value);
  Reply play(const Command& command);
  Refusal renew();
  Refusal rest();

  // In a joint or a bundle (channel_group.cpp):
  /// Whether its mode drives the whole group: it leads the others or is led.
  bool moves_together() const;
  /// Whether this mode drives all channels of the group.
  bool takes_all(Mode mode) const;
  /// Whether the others run this mode after their leader, one after another.
  bool is_handed_over(Mode mode) const;
  /// Whether it acts on its leader's command, whose renewal counts for all.
  bool led() const;
  /// Whether the others allow this one to heat.
  Refusal group_admits(Mode mode, const BoardTick& board) const;
  Refusal joint_admits(Mode mode, const BoardTick& board) const;
  Refusal bundle_admits(const BoardTick& board) const;
  /// Before this channel changes its mode: begins or ends leading the others.
  void lead(Mode mode);
  /// After identify or calibrate: the next channel does the same. False: there is none left, and
  /// this one is done.
  bool hand_over(Mode ended);
  bool hand_over_to(std::size_t place, Mode mode);
  bool waits_for_others() const { return handed_over_ != Mode::rest; }
  void follow_others();
  /// Stops waiting for what the others do for this one.
  void abandon_others();
  /// The leader publishes the progress of the whole group.
  void publish_group(Snapshot& s) const;
  void rest_now();

  std::uint8_t index_;
  std::vector<Channel*> others_;  ///< of its joint or bundle
  Channel* leader_ = nullptr;     ///< null: this one leads, or is alone
  bool bundled_ = false;
  Mode handed_over_ = Mode::rest;   ///< mode that another channel runs for this one; rest: none
  std::size_t handed_over_to_ = 0;  ///< which of the others does
  ChannelState state_;
  Axis axis_;
  Tuner tuner_;
  ChannelSupervisor supervisor_;
  CommandInputs commands_;
  Fault present_fault_ = Fault::none;
  detectors::Margin first_margin_;
  bool cause_is_new_ = false;  ///< no row has shown it yet
  bool reset_requested_ = false;
  /// How another channel's reset, in this tick or the last one, ended for this channel: its own is
  /// answered alike.
  std::optional<Refusal> group_reset_;
  std::uint32_t selector_ = 0;  ///< a fraction, in units of 2⁻³²
  Snapshot snapshot_;
};

}  // namespace supercoil
