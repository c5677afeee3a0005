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

/// What the other muscle of a joint does, as the axis of this one sees it. Of a muscle without
/// another all is zero.
struct Opposition {
  double power_W = 0.0;  ///< that acts, in watts of this muscle: by so much it moves the joint less
  bool limited = false;  ///< that is not what was wanted
  control::PowerRange range{0.0, 0.0};  ///< of power_W
  double held_W = 0.0;                  ///< of that, as Axis::held_W()
  /// By how much its heat moves the joint against this muscle, as HeaterInputs::expected_m.
  detectors::NotResponding::Expected expected_m{};
  double hottest_K = 0.0;      ///< above the air
  bool expected_anew = false;  ///< as AxisInputs'
};

/// What all muscles of a bundle can do together, for the axis that leads it.
struct WholeBundle {
  control::PowerRange range;                  ///< that every heater can give
  double max_W = 0.0;                         ///< that every limiter allows
  double max_hot_W = 0.0;                     ///< likewise, as hot as each muscle may be
  double max_power_ratio = 1.0;               ///< greatest true over measured power
  double hottest_K = 0.0;                     ///< above the air
  LimitedBy limited_by = LimitedBy::nothing;  ///< of those that follow, the first that is
};

/// Reads the channel's state, and never changes it: what ends by itself is told to the channel.
class Axis {
 public:
  /// Devices and state outlive the axis. Allocates; nothing after it does.
  Axis(const ChannelSettings& settings, const BoardSettings& board,
       const board::ChannelDevices& devices, const ChannelState& state);

  // In a tick, in this order.
  void sample(hal::Time now);
  /// In a joint: what the other muscle does since the last tick.
  void oppose(const Opposition& other) {
    other_ = other;
    inputs_.in_joint = true;
    inputs_.expected_anew = inputs_.expected_anew || other.expected_anew;
  }
  /// In a bundle, of its leader: likewise of all.
  void lead(const WholeBundle& whole);
  /// In a bundle, of one that follows: it is the leader's motion.
  void follow_knowledge(const Axis& leader);
  /// What acted since the last tick, and whether the muscle answered. As Heater::observe.
  void observe(double supply_V, const board::Measured* air, std::int64_t periods);
  const AxisInputs& inputs() const { return inputs_; }
  /// The supervisor has judged what happened since the last tick.
  void judged() {
    inputs_.position_elapsed_s = 0.0;
    inputs_.recalibrated.reset();
    inputs_.expected_anew = false;
  }
  /// A sensor that is well cannot give this position.
  void reject_position() { inputs_.position.present = false; }
  /// A probe may have ended calibrate; true when it did.
  bool end_probe();
  void estimate();
  /// True when a mode ended: the axis rests.
  bool control();
  /// What the mode wants: of a joint's agonist, of both muscles together; of its antagonist that is
  /// led, what it is to pull with while no effort is asked for.
  double demanded_W() const { return demanded_.demanded_power_W; }
  /// That its own heater may get now, as hot as the muscle may be and by what it has proven.
  control::PowerRange allowed_range() const;
  /// share_W: what its own heater is to give of that; max_W: no more, with a dither either.
  void limit(double share_W, double max_W = std::numeric_limits<double>::infinity()) {
    share_W_ = share_W;
    heater_.limit(state_, proof_.added_to(share_W, max_W), proof_.max_W());
  }
  bool dithers() const { return proof_.dither_W() != 0.0; }
  /// In a bundle, of one that follows: the leader's demand and, of that, the power of its heater.
  void follow_power(double demanded_W, double power_W);
  /// A dither that one of a bundle cannot follow is none.
  void drive() {
    const double dither_W = followers_limited() ? 0.0 : proof_.dither_W();
    heater_.drive(state_, may_probe(), dither_W);
  }
  /// Its part of what is published, with the heater's. selector: of a full turn, chooses what is
  /// told in turn.
  void publish(std::uint32_t selector, Snapshot& s) const;

  /// Whether it may be armed: everything is measured, and how hot the muscle is is known.
  bool ready() const;
  /// Whether a command to heat can be followed. What it asks for is limited to what is reachable.
  Reply admits(Mode mode, double& value) const;
  /// The channel became active.
  void start() { estimation_.restart(); }
  /// Commands of a trajectory.
  Reply play(const Command& command);
  /// In a joint, of its antagonist: what it pulls with while no effort is asked for.
  Reply pull_with(double power_W);
  /// In a joint, the most of that; what the heater may have bounds it as well.
  void limit_pull(double max_W) { max_pull_W_ = max_W; }
  /// In a joint, of power for this muscle while the other one is driven by itself as well: the
  /// smaller of the two powers is what they pull against each other with.
  Reply admits_against(const Axis& other, double power_W) const;
  double max_travel_m() const { return settings_.supervision.max_travel_m; }
  /// In a joint, of its agonist: how far the other muscle may pull it.
  void limit_reverse_travel(double max_m) {
    max_reverse_travel_m_ = max_m;
    publish_muscle();
  }
  /// m, or W in open loop, in Mode::joint and in Mode::bundle.
  double reference() const { return reference_; }
  /// Follows what was admitted. value: m, or W in open loop.
  void follow(Mode mode, double value);
  void rest();
  /// Cold, at once.
  void disarm();
  /// Commands that neither arm nor heat.
  Reply obey(const Command& command);

  /// As other_ of the other muscle's axis. gain_ratio: of this one's gain over its; lever_ratio: of
  /// its lever over this one's.
  Opposition opposition(double gain_ratio, double lever_ratio) const;
  /// In a joint, by the model; NaN: not known, as of the next.
  double pull_N() const {
    return inputs_.position.present ? pull_.at_N(inputs_.position.value, muscle_) : NAN;
  }
  /// In a joint: the steady power with which this muscle is taut where the joint stands.
  double taut_W() const {
    return inputs_.position.present ? pull_.taut_W(inputs_.position.value, muscle_) : NAN;
  }
  /// In a joint: as ModelledPull has it.
  double heat_W() const { return pull_.heat_W(); }
  /// Of the muscle as it is known.
  double dc_gain_m_per_W() const { return muscle_.dc_gain_m_per_W(); }
  /// Another number whenever something else is known of the muscle's motion.
  std::uint32_t knowledge() const { return knowledge_; }
  Mode mode() const { return mode_; }
  /// The last identify or calibrate did.
  bool has_found() const {
    return result_ == ModeResult::found || result_ == ModeResult::not_stored;
  }
  ModeResult result() const { return result_; }
  /// In a bundle, of its leader: how the last of them ended what all had to do.
  void conclude(ModeResult result) { result_ = result; }
  bool follows_position() const { return state_.may_heat() && mode_ == Mode::position; }

  const Estimation& estimation() const { return estimation_; }
  Heater& heater() { return heater_; }
  const Heater& heater() const { return heater_; }
  /// From any thread.
  double published_muscle(std::size_t quantity) const { return published_muscle_.get(quantity); }
  /// Of the trajectory; from any thread.
  PlaybackStatus playback() const { return playback_.status(); }
  void align_playback(double ahead_s) { playback_.align(ahead_s); }
  /// As Channel::take_learned_update.
  bool take_learned_update(board::LearnedUpdate& update) { return learned_updates_.pop(update); }

 private:
  /// What a reading of the sensor is by the present calibration.
  double calibrated(double sensor_m) const {
    return settings_.joint.position_of_reading_m((sensor_m - calibration_.position_offset_m) *
                                                 calibration_.position_scale);
  }
  /// That moves the muscle, in watts of its own.
  double moving_W() const { return heater_.acting().power_W - other_.power_W; }
  /// Of its own heater, or of all those of its bundle.
  control::PowerRange own_range() const;
  /// That there is for a while, beside the muscle that pulls against it.
  control::PowerRange range() const;
  /// Of that, what a reference may count on: it falls to what can be held for good as the muscle,
  /// or the other one, may become hot.
  control::PowerRange held_range() const;
  double held_W() const;  ///< of own_range()
  /// What acts is not what was wanted.
  bool is_limited() const {
    return heater_.acting().limited || other_.limited || followers_limited();
  }
  bool followers_limited() const { return bundle_ && bundle_->limited_by != LimitedBy::nothing; }
  void prove(std::int64_t periods);
  void plan_proof();
  /// Of all muscles that move together, allowed by their limiters; as hot as they may be.
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
  /// The power of its heater is known to be steady, if it does not change.
  bool holds_power() const {
    return state_.may_heat() && (mode_ == Mode::power || mode_ == Mode::bundle);
  }

  /// Calibrate probes when it has found the zero, and not before. While somebody reads a meter no
  /// pulse is to be in what it shows, for as long as a file may leave a heater without one.
  bool may_probe() const {
    constexpr double max_unprobed_s = 600.0;
    const bool read = comparison_.begun() && holds_power();
    return mode_ != Mode::calibrate && !(read && heater_.resistance_age_s() < max_unprobed_s);
  }

  board::Learned known() const;
  void publish_muscle();
  static Refusal refusal_of(ModeResult kept);
  ModeResult keep(const control::PhysicalParameters& muscle, const board::Calibration& found);
  ModeResult keep_identified();
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

  // Known of the muscle; of its heat and of the senses the heater knows.
  control::PhysicalParameters muscle_;  ///< as configured, learned before, or identified since
  bool has_muscle_;                     ///< learned before or since: what is stored has it
  board::Calibration calibration_;
  double response_ratio_;     ///< of small motions, as ProofSettings has it; 0: not measured
  double unexplained_ratio_;  ///< by that muscle, when identify found it; 0: not measured
  board::Identification identification_;  ///< without a date: since the start
  board::StoredTuning stored_tuning_;
  std::uint32_t knowledge_ = 0;     ///< counts what was learned of the motion
  std::uint32_t knows_from_ = -1U;  ///< of the leader's, as it was taken over
  PublishedMuscle published_muscle_;
  boost::lockfree::spsc_queue<board::LearnedUpdate, boost::lockfree::capacity<4>> learned_updates_;

  Mode mode_ = Mode::rest;
  hal::Time now_{};
  Playback playback_;
  double reference_ = 0.0;  ///< as reference()
  double max_pull_W_ = std::numeric_limits<double>::infinity();
  /// Below rest. Of a single muscle as far as above it.
  double max_reverse_travel_m_ = settings_.supervision.max_travel_m;
  control::ControllerOutput demanded_;
  double share_W_ = 0.0;  ///< of that, from its own heater
  modes::Identify identify_;
  std::unique_ptr<control::CoolingFit> cooling_fit_;  ///< of a weighed muscle; 36 kB
  SmallSignal small_signal_;                          ///< the end of identify
  modes::Calibrate calibrate_;
  ModeResult result_ = ModeResult::none;  ///< of either
  board::MeterComparison comparison_;
  board::SteadyState steady_state_;
};

}  // namespace supercoil
