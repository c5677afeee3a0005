// One muscle's motion: its position, its heater, what is known of it, and what moves it.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include <boost/lockfree/spsc_queue.hpp>

#include "supercoil/control/estimation/cooling_fit.hpp"

#include "board/meter_comparison.hpp"
#include "board/steady_state.hpp"
#include "loop/command.hpp"
#include "loop/estimation.hpp"
#include "loop/heater.hpp"
#include "loop/known_muscle.hpp"
#include "loop/modelled_pull.hpp"
#include "loop/playback.hpp"
#include "loop/settings.hpp"
#include "loop/snapshot.hpp"
#include "loop/tracking.hpp"
#include "modes/calibrate.hpp"
#include "modes/identify.hpp"
#include "supervisor/channel_inputs.hpp"
#include "supervisor/channel_state.hpp"
#include "supervisor/proof.hpp"
#include "supervisor/small_signal.hpp"

namespace supercoil {

/// What the other muscle of a joint does, as this one's axis sees it. All zero without another
/// muscle.
struct Opposition {
  double power_W = 0.0;  ///< acting, in this muscle's watts: subtracts from this muscle's power
  bool limited = false;  ///< power_W is not what was wanted
  control::PowerRange range{0.0, 0.0};  ///< of power_W
  double held_W = 0.0;                  ///< of power_W, as Axis::held_W()
  /// How far its heat moves the joint against this muscle, as in HeaterInputs::expected_m.
  detectors::NotResponding::Expected expected_m{};
  double hottest_K = 0.0;        ///< above the air
  bool expected_jumped = false;  ///< as in AxisInputs
};

/// What all muscles of a bundle can do together, for the leader's axis.
struct WholeBundle {
  control::PowerRange range;                  ///< that every heater can give
  double max_W = 0.0;                         ///< that every limiter allows
  double max_hot_W = 0.0;                     ///< likewise, at each muscle's hottest
  double max_power_ratio = 1.0;               ///< maximum of true over measured power
  double hottest_K = 0.0;                     ///< above the air
  LimitedBy limited_by = LimitedBy::nothing;  ///< of the first follower that is limited
};

/// Reads the channel's state, never changes it, and reports when a mode has ended by itself.
class Axis {
 public:
  /// Devices and state outlive the axis. Allocates; later calls do not.
  Axis(const ChannelSettings& settings, const BoardSettings& board,
       const board::ChannelDevices& devices, const ChannelState& state);

  // In a tick, in this order.
  /// Takes the newest readings of the position and the current; one that is too old is not present.
  void sample(hal::Time now);
  /// In a joint: what the other muscle has done since the last tick.
  void oppose(const Opposition& other) {
    other_ = other;
    inputs_.in_joint = true;
    inputs_.expected_jumped = inputs_.expected_jumped || other.expected_jumped;
  }
  /// For a bundle's leader: likewise for the whole bundle.
  void lead(const WholeBundle& whole);
  /// For a bundle's follower: takes over what the leader knows of the motion.
  void follow_knowledge(const Axis& leader);
  /// What acted since the last tick, and whether the muscle responded; see Heater::observe.
  void observe(double supply_V, const board::Measured* air, std::int64_t periods);
  const AxisInputs& inputs() const { return inputs_; }
  /// The supervisor has judged what happened since the last tick.
  void clear_events() {
    inputs_.position_elapsed_s = 0.0;
    inputs_.recalibrated.reset();
    inputs_.expected_jumped = false;
  }
  /// A healthy sensor cannot give this position.
  void reject_position() { inputs_.position.present = false; }
  /// True when a probe has ended calibrate.
  bool end_probe();
  void estimate();
  /// True when a mode ended: the axis rests.
  bool control();
  /// The mode's demand. For a joint's agonist: of both muscles together; for its led antagonist:
  /// its power while no effort is asked for.
  double demanded_W() const { return demanded_.demanded_power_W; }
  /// The power that its own heater may get now, by the muscle's hottest and by what it has proven.
  control::PowerRange allowed_range() const;
  /// share_W: its own heater's share of the demand; max_W: the limit, including a dither.
  void limit(double share_W, double max_W = std::numeric_limits<double>::infinity());
  bool dithers() const { return proof_.dither_W() != 0.0; }
  /// For a bundle's follower: the leader's demand, and the power of this heater.
  void follow_power(double demanded_W, double power_W);
  /// No dither unless all muscles of a bundle can follow it.
  void drive() {
    const double dither_W = followers_limited() ? 0.0 : proof_.dither_W();
    heater_.drive(state_, may_probe(), dither_W);
  }
  /// Publishes the axis and its heater. selector over 2³² chooses what is published in turn.
  void publish(std::uint32_t selector, Snapshot& s) const;

  /// Whether it may be armed: everything is measured, and the muscle's temperature is known.
  bool ready() const;
  /// Whether a command to heat can be followed. Limits its value to what is reachable.
  Reply admits(Mode mode, double& value) const;
  /// The channel became active.
  void start() { estimation_.restart(); }
  /// Obeys commands of a trajectory.
  Reply play(const Command& command);
  /// For a joint's antagonist: its power while no effort is asked for.
  Reply pull_with(double power_W);
  /// In a joint, the maximum of that power; the heater's own limit holds as well.
  void limit_pull(double max_W) { max_pull_W_ = max_W; }
  /// In a joint, whether this muscle may get this power while the other is driven separately: they
  /// pull against each other with the smaller of the two powers.
  Reply admits_against(const Axis& other, double power_W) const;
  double max_travel_m() const { return settings_.supervision.max_travel_m; }
  double min_travel_m() const { return 0.0 - max_reverse_travel_m_; }  // never -0
  /// For a joint's agonist: how far the other muscle may pull it.
  void limit_reverse_travel(double max_m) {
    max_reverse_travel_m_ = max_m;
    publish_muscle();
  }
  /// m, or W in open loop, in Mode::joint and in Mode::bundle.
  double reference() const { return reference_; }
  /// Follows an admitted command. value: m, or W in open loop.
  void follow(Mode mode, double value);
  void rest();
  /// Cold, at once.
  void disarm();
  /// Commands that neither arm nor heat.
  Reply obey(const Command& command);

  /// For other_ of the other muscle's axis. gain_ratio: this muscle's gain over the other's;
  /// lever_ratio: the other's lever over this one's.
  Opposition opposition(double gain_ratio, double lever_ratio) const;
  /// In a joint, by the model; NaN: not known, likewise for taut_W().
  double pull_N() const {
    return inputs_.position.present ? pull_.at_N(inputs_.position.value, muscle_) : NAN;
  }
  /// In a joint: the steady power that keeps this muscle taut at the joint's position.
  double taut_W() const {
    return inputs_.position.present ? pull_.taut_W(inputs_.position.value, muscle_) : NAN;
  }
  /// In a joint: see ModelledPull.
  double heat_W() const { return pull_.heat_W(); }
  /// Of the muscle as now known.
  double dc_gain_m_per_W() const { return muscle_.dc_gain_m_per_W(); }
  /// Changes whenever the knowledge of the muscle's motion changes.
  std::uint32_t knowledge() const { return knowledge_; }
  Mode mode() const { return mode_; }
  /// The last identify or calibrate succeeded.
  bool has_found() const {
    return result_ == ModeResult::found || result_ == ModeResult::not_stored;
  }
  ModeResult result() const { return result_; }
  /// For a bundle's leader: the result of what all its channels had to do.
  void conclude(ModeResult result) { result_ = result; }
  bool follows_position() const { return state_.may_heat() && mode_ == Mode::position; }

  const Estimation& estimation() const { return estimation_; }
  Heater& heater() { return heater_; }
  const Heater& heater() const { return heater_; }
  /// From any thread.
  double published_muscle(std::size_t quantity) const { return published_muscle_.get(quantity); }
  /// Of the trajectory; from any thread.
  PlaybackStatus playback() const { return playback_.status(); }
  /// As Playback::align; from one other thread.
  void align_playback(double ahead_s) { playback_.align(ahead_s); }
  /// As Channel::take_learned_update.
  bool take_learned_update(board::LearnedUpdate& update) { return learned_updates_.pop(update); }

 private:
  /// A sensor reading as a position, by the present calibration.
  double calibrated(double sensor_m) const {
    return settings_.joint.position_of_reading_m((sensor_m - calibration_.position_offset_m) *
                                                 calibration_.position_scale);
  }
  /// The power that moves the muscle, in its own watts.
  double moving_W() const { return heater_.acting().power_W - other_.power_W; }
  /// Range of its own heater, or of all heaters of its bundle.
  control::PowerRange own_range() const;
  /// Range available for a while, given the muscle that pulls against it.
  control::PowerRange range() const;
  /// The part of it that a reference may count on: it falls to what can be held indefinitely as
  /// this muscle or the other one may become hot.
  control::PowerRange held_range() const;
  double held_W() const;  ///< of own_range()
  /// The acting power is not what was wanted.
  bool is_limited() const {
    return heater_.acting().limited || other_.limited || followers_limited();
  }
  bool followers_limited() const { return bundle_ && bundle_->limited_by != LimitedBy::nothing; }
  double from_position_K() const;
  void prove(std::int64_t periods);
  void plan_proof();
  /// Maximum by the limiters of all muscles that move together; max_hot_W(): at their hottest.
  double max_W() const;
  double max_hot_W() const;
  void learn_heat();
  LimitedBy limited_by() const;
  LimitedBy held_by() const;
  void enter(Mode mode);

  bool step_identify();
  bool step_small_signal();
  bool step_calibrate();
  bool end_mode(ModeResult result);
  void update_cooling_fit();
  bool learn_cooling();

  Reply scale(double true_m);
  Reply choose_controller(double place);
  Reply choose_estimator(double place);
  Reply tune(const Command& command);
  Refusal store(const Command& command);
  Refusal keep_tuning(const Command& command);
  Refusal compare(board::MeterComparison::Sense sense, double meter);
  Refusal compare_rise(double rise_K);
  Refusal apply_comparison(const board::SenseComparison& senses);
  void follow_comparisons();
  void restart_comparisons();
  /// Its mode allows the heater's power to be steady.
  bool holds_power() const {
    return state_.may_heat() && (mode_ == Mode::power || mode_ == Mode::bundle);
  }

  /// Calibrate probes only once it has found the zero. While a meter is read no pulse may disturb
  /// its reading, for as long as a file may leave a heater without a probe.
  bool may_probe() const {
    constexpr double max_unprobed_s = 600.0;
    const bool read = comparison_.begun() && holds_power();
    return mode_ != Mode::calibrate && !(read && heater_.resistance_age_s() < max_unprobed_s);
  }

  board::Learned known() const;
  void forget_muscle(board::Learned& learned) const;
  void publish_muscle();
  static Refusal refusal_of(ModeResult kept);
  ModeResult keep(const control::PhysicalParameters& muscle, const board::Calibration& found);
  ModeResult keep_fitted(const control::PhysicalParameters& muscle, double unexplained_ratio,
                         const board::Identification& identification);
  ModeResult keep_identified(double response_ratio);
  Refusal store_thermal_facts(const board::ThermalFacts& facts);
  void calibrate(const board::Calibration& calibration);

  ChannelSettings settings_;
  const ChannelState& state_;
  double step_s_;
  hal::AdcChannel* sensor_;
  hal::Time position_taken_{-1};
  AxisInputs inputs_;
  Heater heater_;
  Opposition other_;
  ModelledPull pull_;
  std::optional<WholeBundle> bundle_;  ///< that it leads
  Tracking tracking_;
  Estimation estimation_;
  std::int64_t ticks_per_s_;
  std::int64_t estimated_ticks_ = 0;  ///< in this second
  Proof proof_;

  // Known of the muscle; the heater knows its heat and the senses.
  control::PhysicalParameters muscle_;  ///< as configured, learned before, or identified since
  bool has_muscle_;                     ///< learned before or since: the stored set contains it
  bool cleared_ = false;                ///< by a command; nothing was found since
  board::Calibration calibration_;
  double response_ratio_;     ///< of small motions, as ProofSettings has it; 0: not measured
  double unexplained_ratio_;  ///< by that muscle, if identify found it; 0: not measured
  board::Identification identification_;  ///< without a date: found since the start
  board::StoredTuning stored_tuning_;
  std::uint32_t knowledge_ = 0;           ///< counts changes of what is known of the motion
  std::uint32_t leader_knowledge_ = -1U;  ///< the leader's knowledge_ when it was taken over
  PublishedMuscle published_muscle_;
  boost::lockfree::spsc_queue<board::LearnedUpdate, boost::lockfree::capacity<4>> learned_updates_;

  Mode mode_ = Mode::rest;
  hal::Time now_{};
  Playback playback_;
  double reference_ = 0.0;  ///< as reference()
  double max_pull_W_ = std::numeric_limits<double>::infinity();
  /// Below rest; for a single muscle as far as above it. Nothing turns a joint of one muscle back.
  double max_reverse_travel_m_ = settings_.joint.turns() && !settings_.joint.has_other()
                                     ? 0.0
                                     : settings_.supervision.max_travel_m;
  control::ControllerOutput demanded_;
  double share_W_ = 0.0;  ///< its own heater's share of the demand
  modes::Identify identify_;
  std::unique_ptr<control::CoolingFit> cooling_fit_;  ///< of a weighed muscle; 36 kB
  SmallSignal small_signal_;                          ///< the end of identify
  modes::Calibrate calibrate_;
  ModeResult result_ = ModeResult::none;  ///< of either
  board::MeterComparison comparison_;
  board::SteadyState steady_state_;
};

}  // namespace supercoil
