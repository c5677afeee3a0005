// One muscle's channel: its state, its supervisor, and the stages of its tick in their order.
#pragma once

#include <cmath>
#include <cstdint>

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
  detectors::Margin margin;   ///< of that fault
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

  /// Before the first tick: the other channel of its joint, which outlives it. leads: commands to
  /// follow a position come to this one.
  void join(Channel& other, bool leads) {
    other_ = &other;
    leads_ = leads;
  }
  Axis& axis() { return axis_; }

  // The stages of a tick, in this order.
  void sample(hal::Time now);
  Answer answer(const Command& command, const BoardTick& board);
  void supervise(const BoardTick& board);
  void estimate() { axis_.estimate(); }
  void control();
  void limit() { axis_.limit(axis_.demanded_W()); }  ///< in a joint it is Joint::limit's
  void drive() { axis_.drive(); }
  const Snapshot& publish(const BoardTick& board, const Verdict& board_verdict);

  /// The one way of making the channel safe, and the other one of its joint: duty 0 and enable low,
  /// at once. Fault::none is an ordinary stop.
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
  /// In the thread that sends commands, as all of the tuner.
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

  // In a joint (channel_in_joint.cpp):
  /// It follows the joint's position, or is led by the other one that does.
  bool moves_joint() const;
  /// What it does is part of what the other one was told: that one is renewed for both.
  bool led() const;
  /// Whether the other one lets this one heat.
  Refusal joint_admits(Mode mode, const BoardTick& board) const;
  /// Before this one's mode changes: the other one begins, or ends, to be led.
  void lead(Mode mode);
  /// After identify or calibrate of the one that leads: the other one does the same. False: it does
  /// not, and this one is done.
  bool hand_over(Mode ended);
  bool waits_for_other() const { return handed_over_ != Mode::rest; }
  void follow_other();
  /// In a joint what leads tells how far both are.
  void publish_joint(Snapshot& s) const;
  void rest_now();

  std::uint8_t index_;
  Channel* other_ = nullptr;  ///< of its joint; null: it is in none
  bool leads_ = true;
  Mode handed_over_ = Mode::rest;  ///< what the other one does for this one, if anything
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
