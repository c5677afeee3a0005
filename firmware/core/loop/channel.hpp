// One muscle: everything that happens to it in a tick, in the order of the loop's stages.
#pragma once

#include <cstdint>
#include <memory>

#include <boost/lockfree/spsc_queue.hpp>

#include "supercoil/control/estimation/cooling_fit.hpp"

#include "board/learned.hpp"
#include "board/meter_comparison.hpp"
#include "board/steady_heat.hpp"
#include "loop/command.hpp"
#include "loop/heater.hpp"
#include "loop/settings.hpp"
#include "loop/smoothed.hpp"
#include "loop/snapshot.hpp"
#include "modes/calibrate.hpp"
#include "modes/identify.hpp"
#include "supervisor/channel_supervisor.hpp"

namespace supercoil {

/// What the whole board tells its channels at a tick.
struct BoardNow {
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

  // The stages of a tick, in this order.
  void sample(hal::Time now);
  Answer answer(const Command& command, const BoardNow& board);
  void supervise(const BoardNow& board);
  void estimate();
  void control();
  void limit();
  void drive();
  const Snapshot& publish(const BoardNow& board, const Verdict& board_verdict);

  /// The one way of making the channel safe: duty 0 and enable low, at once. Fault::none is an
  /// ordinary stop.
  void disarm(Fault cause, const detectors::Margin& margin = {});
  /// For the self-test: a duty and the enable line by hand. Only while disarmed.
  void test_drive(double duty, bool enable) { heater_.test_drive(duty, enable); }
  double measured_current_A() const {
    return heater_.current().present ? heater_.current().value : INFINITY;
  }
  /// A command was damaged on its way, and obeyed by nobody.
  void note_damaged() { evidence_.damaged_command = true; }

  /// Only an obeyed command ends a row of damaged or refused ones.
  void note_answer(Refusal refusal) {
    if (refusal == Refusal::wrong_state) evidence_.refused_command = true;
    if (refusal == Refusal::none) evidence_.obeyed_command = true;
  }

  const ChannelState& state() const { return state_; }
  const Snapshot& snapshot() const { return snapshot_; }
  const Verdict& verdict() const { return supervisor_.verdict(); }
  /// The margin of the detector that led to `fault`, as it was then.
  const detectors::Margin& first_margin() const { return first_margin_; }
  /// The fault of the whole board that one of this channel's detectors sees now.
  Fault present_board_fault() const { return supervisor_.verdict().board_fault(); }
  /// The fault that a detector sees now, latched or not.
  Fault present_fault() const { return present_fault_; }
  const std::optional<control::Estimate>& estimates() const { return estimate_; }
  bool lines_ok() const { return heater_.lines_ok(); }
  /// Between ticks only: what the limiter allows from now on.
  void set_power_range(double min_W, double max_W) {
    heater_.set_power_range(min_W, max_W);
    allow_power(max_W);
  }
  /// From one other thread, and from the next tick on: no more power than this, nor than the
  /// configured maximum. most_W: at least 0.
  void allow_power(double most_W) { heater_.allow_power(most_W); }
  double most_power_W() const { return heater_.max_power_W(); }
  /// By which the readings are corrected, without its date; from any thread.
  board::SenseComparison senses() const { return heater_.told_senses(); }
  /// What identify or calibrate found, or was asked to store or clear; from one other thread.
  bool take_lesson(board::Lesson& lesson) { return lessons_.pop(lesson); }

 private:
  Refusal obey(const Command& command, const BoardNow& board);
  /// nearest: what would have been obeyed.
  Refusal refuse_beyond(double nearest) {
    nearest_ = nearest;
    return Refusal::out_of_range;
  }
  Refusal refuse_place(double place, std::size_t places);
  Refusal arm(const BoardNow& board);
  Refusal heat(Mode mode, double value, const BoardNow& board);
  Refusal scale(double true_m);
  Refusal store(double what);
  Refusal compare(board::MeterComparison::Sense sense, double meter);
  Refusal go_by(const board::SenseComparison& senses);
  void follow_comparison();
  void restart_comparisons();
  Refusal compare_rise(double rise_K);
  void follow_steady_heat(bool steady);
  void follow_cooling();
  bool learn_cooling();
  bool keep_heat(const board::HeatFacts& facts);
  Refusal choose_controller(double place);
  Refusal choose_estimator(double place);
  void enter(Mode mode);
  control::ControllerStart start_here() const;
  void start_controller(std::size_t place, const control::ControllerStart& at);
  void rest();
  void sample_position(hal::Time now);
  void learn_heat();
  /// Empty: no estimate is trusted, or it is no muscle's.
  std::optional<control::PhysicalParameters> trusted_muscle() const;
  void step_identify();
  void step_small_signal();
  void step_calibrate();
  void end_calibrate(double cold_Ohm);
  void end_mode(ModeResult result);
  ModeResult keep(const control::PhysicalParameters& muscle, const board::Calibration& found);
  /// From now on; the resistance is the heater's.
  void calibrate(const board::Calibration& calibration) {
    calibration_ = calibration;
    heater_.calibrate(calibration.cold_resistance_Ohm);
  }
  LimitedBy limited_by() const;
  void prove(std::int64_t periods);
  void publish_estimate();
  control::Estimator& estimator() { return estimators_[estimator_]; }
  const control::Estimator& estimator() const { return estimators_[estimator_]; }

  ChannelSettings settings_;
  hal::AdcChannel* sensor_;  ///< of the position
  double step_s_;
  std::int64_t ticks_per_s_;
  std::uint8_t index_;

  Heater heater_;
  board::Calibration calibration_;
  board::MeterComparison comparison_;
  board::SteadyHeat steady_heat_;
  ChannelState state_;
  ChannelSupervisor supervisor_;
  Evidence evidence_;
  Fault present_fault_ = Fault::none;
  detectors::Margin first_margin_;
  bool cause_is_new_ = false;  ///< no row has told it yet

  hal::Time position_taken_{-1};
  control::PhysicalParameters muscle_;  ///< as configured, learned before, or identified since
  bool knows_muscle_;                   ///< learned before or since: what is stored has it
  Proof proof_;
  double answer_ratio_;  ///< of small motions, as ProofSettings has it; 0: not measured

  std::vector<control::Controller> controllers_;
  std::vector<control::Estimator> estimators_;
  std::optional<control::Estimate> estimate_;  ///< the chosen estimator's, as it is now
  std::size_t controller_ = 0;
  std::size_t estimator_ = 0;
  Mode mode_ = Mode::rest;
  double reference_ = 0.0;  ///< m, or W in open loop
  modes::Identify identify_;
  std::unique_ptr<control::CoolingFit> cooling_fit_;  ///< of a weighed muscle; 36 kB
  SmallSignal small_signal_;                          ///< the end of identify
  modes::Calibrate calibrate_{{}};
  ModeResult result_ = ModeResult::none;  ///< of either
  control::ControllerOutput wanted_;
  Smoothed smooth_power_W_;
  Smoothed smooth_error_m_;  ///< position over the reference model
  bool reset_asked_ = false;
  double nearest_ = NAN;    ///< to the value that is refused
  std::uint32_t turn_ = 0;  ///< of a full turn
  std::int64_t ticks_ = 0;  ///< of learning, in this second
  Snapshot snapshot_;
  boost::lockfree::spsc_queue<board::Lesson, boost::lockfree::capacity<4>> lessons_;
};

}  // namespace supercoil
