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

/// What the whole board tells its channels at a tick.
struct BoardTick {
  hal::Time time{};
  double supply_V = 0.0;
  Fault fault = Fault::none;  ///< of the board, latched or present: every channel is made safe
  detectors::Margin margin;   ///< of that fault; the bus's faults are told with it
  bool testing = true;        ///< the self-test runs: nothing is latched
  bool proven = false;        ///< it has passed: both ways of cutting cut
  std::int64_t periods = 1;   ///< since the last tick
  const board::Measured* air = nullptr;  ///< in °C; null: no sensor
};

class Channel {
 public:
  /// index: from 0. Devices outlive the channel. Allocates; nothing after it does.
  Channel(const ChannelSettings& settings, const BoardSettings& board,
          const board::ChannelDevices& devices, std::uint8_t index);
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  // Before the first tick, of channels that outlive each other:
  /// Both are in a joint. What follows a position comes to this one.
  void lead_joint(Channel& antagonist);
  /// They are a bundle, and all commands come to this one.
  void lead_bundle(std::vector<Channel*> followers);
  Axis& axis() { return axis_; }

  // The stages of a tick, in this order.
  void sample(hal::Time now);
  Reply answer(const Command& command, const BoardTick& board);
  void supervise(const BoardTick& board);
  void estimate() { axis_.estimate(); }
  void control();
  void limit() { axis_.limit(axis_.demanded_W()); }  ///< in a joint it is Joint::limit's
  void drive() { axis_.drive(); }
  const Snapshot& publish(const BoardTick& board, const Verdict& board_verdict);

  /// The one way of making the channel safe, and all others of its joint or bundle: duty 0 and
  /// enable low, at once. Fault::none is an ordinary stop.
  void disarm(Fault cause, const detectors::Margin& margin = {});
  /// For the self-test: a duty and the enable line by hand. Only while disarmed.
  void test_drive(double duty, bool enable) { axis_.heater().test_drive(duty, enable); }
  double measured_current_A() const {
    const board::Measured& current = axis_.heater().current();
    return current.present ? current.value : INFINITY;
  }
  /// A command was damaged on its way, and obeyed by nobody.
  void note_damaged() { commands_.damaged = true; }

  const ChannelState& state() const { return state_; }
  const Snapshot& snapshot() const { return snapshot_; }
  const Verdict& verdict() const { return supervisor_.verdict(); }
  /// The margin of the detector that led to `fault`, as it was then.
  const detectors::Margin& first_margin() const { return first_margin_; }
  /// The fault of the whole board that one of this channel's detectors sees now.
  Fault present_board_fault() const { return supervisor_.verdict().board_fault(); }
  /// The fault that a detector sees now, latched or not.
  Fault present_fault() const { return present_fault_; }
  /// Of the muscle as it is known; between ticks only.
  double dc_gain_m_per_W() const { return axis_.dc_gain_m_per_W(); }
  const std::optional<control::Estimate>& estimates() const {
    return axis_.estimation().estimate();
  }
  bool lines_ok() const { return axis_.heater().lines_ok(); }
  /// Between ticks only: what the limiter allows from now on.
  void set_power_range(double min_W, double max_W) {
    axis_.heater().set_power_range(min_W, max_W);
    allow_power(max_W);
  }
  /// From one other thread, and from the next tick on: no more power than this, nor than the
  /// configured maximum. max_W: at least 0.
  void allow_power(double max_W) { axis_.heater().allow_power(max_W); }
  double max_power_W() const { return axis_.heater().max_power_W(); }
  /// By which the readings are corrected, without its date; from any thread.
  board::SenseComparison senses() const { return axis_.heater().published_senses(); }
  /// What it knows of its muscle, a place in known_quantities; NaN: not known. From any thread.
  double known(std::size_t quantity) const { return axis_.published_muscle(quantity); }
  /// Of the trajectory; from any thread.
  PlaybackStatus playback() const { return axis_.playback(); }
  /// As Playback::align; from one other thread.
  void align_playback(double ahead_s) { axis_.align_playback(ahead_s); }
  /// Of what is_tuning(). In the thread that sends commands, as all of the tuner.
  void add_tuning(Command& command);
  Tuner& tuner() { return tuner_; }
  const Tuner& tuner() const { return tuner_; }
  /// What identify or calibrate found, or was asked to store or clear; from one other thread.
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
  /// It does what takes all of them, or is led by the one that does.
  bool moves_together() const;
  /// In this mode it takes all of them.
  bool takes_all(Mode mode) const;
  /// After this mode of the one that leads the others do the same, one after the other.
  bool is_handed_over(Mode mode) const;
  /// What it does is part of what the leader was told: that one is renewed for all.
  bool led() const;
  /// Whether the others let this one heat.
  Refusal group_admits(Mode mode, const BoardTick& board) const;
  Refusal joint_admits(Mode mode, const BoardTick& board) const;
  Refusal bundle_admits(const BoardTick& board) const;
  /// Before this one's mode changes: the others begin, or end, to be led.
  void lead(Mode mode);
  /// After identify or calibrate: the next one does the same. False: none does, and this one is
  /// done.
  bool hand_over(Mode ended);
  bool hand_over_to(std::size_t place, Mode mode);
  bool waits_for_others() const { return handed_over_ != Mode::rest; }
  void follow_others();
  /// What they do for this one is not waited for any more.
  void abandon_others();
  /// What leads tells how far all are.
  void publish_group(Snapshot& s) const;
  void rest_now();

  std::uint8_t index_;
  std::vector<Channel*> others_;  ///< of its joint or bundle
  Channel* leader_ = nullptr;     ///< of them, when it is not this one
  bool bundled_ = false;
  Mode handed_over_ = Mode::rest;   ///< what another one does for this one, if anything
  std::size_t handed_over_to_ = 0;  ///< which of the others does
  ChannelState state_;
  Axis axis_;
  Tuner tuner_;
  ChannelSupervisor supervisor_;
  CommandInputs commands_;
  Fault present_fault_ = Fault::none;
  detectors::Margin first_margin_;
  bool cause_is_new_ = false;  ///< no row has told it yet
  bool reset_requested_ = false;
  std::uint32_t selector_ = 0;  ///< of a full turn
  Snapshot snapshot_;
};

}  // namespace supercoil
