// All that the loop needs to know of a board, in SI units, checked before it starts.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/joint/lever.hpp"
#include "supercoil/control/tracking/controller.hpp"
#include "supercoil/control/tracking/loop_margin.hpp"

#include "board/heat.hpp"
#include "board/learned.hpp"
#include "board/measurement.hpp"
#include "board/power_bounds.hpp"
#include "supervisor/limiter.hpp"
#include "supervisor/proof.hpp"
#include "supervisor/supervision.hpp"

namespace supercoil {

/// A converter's input: what its counts mean, and how old a value may be.
struct InputSettings {
  board::Scaling scaling;
  double max_age_s = 0.01;
};

/// The heater as the power stage and its measurement see it.
struct HeaterSettings {
  InputSettings current;
  double sense_filter_s = 0.0;  ///< time constant of the averaging current sense; 0: a tick's mean
  double resistance_filter_s = 0.2;  ///< smoothing of the measured resistance
  double cold_resistance_Ohm = 10.0;
  double temperature_coefficient_per_K = 0.0;  ///< of the resistance; 0: it tells no temperature
  double probe_duty = 0.02;                    ///< at most 0.02
  double probe_s = 0.05;                       ///< at most 0.05
  double probe_every_s = 5.0;  ///< while hot below probe_duty: the age at which it probes again
  bool error_feedback = true;  ///< of the duty's rounding
  int pwm_steps = 4095;        ///< of a period, as the output has them
  double delay_s = 0.0;        ///< from a duty's setting to its acting
};

/// The joint that a channel's muscle turns.
struct PlaceInJoint {
  int direction =
      0;  ///< the joint turns with the position (1) or against it (-1); 0: there is none
  control::Lever lever{};
  /// From this one: 1 is the next. NaN: none but a spring or a weight turns the joint as well.
  double other_channel_offset = NAN;
  double pretension_N = NAN;     ///< its pull, cold and at the angle 0; NaN: not known
  double stiffness_ratio = 0.5;  ///< its own share of the stiffness that its muscle describes
  double weight_Nm = 0.0;     ///< of an arm that alone draws it back, when level; 0: another does
  double hangs_at_rad = 0.0;  ///< that arm would, without the muscle; at most 0

  bool turns() const { return direction != 0; }
  bool has_other() const { return std::isfinite(other_channel_offset); }

  bool weighs() const { return weight_Nm > 0.0; }

  bool knows_pull() const { return std::isfinite(pretension_N); }
  /// What is left of the cold muscle's pull where it has contracted so far; < 0: it is slack.
  /// stiffness_N_per_m: that its muscle describes.
  double cold_pull_N(double position_m, double stiffness_N_per_m) const {
    return pretension_N - stiffness_ratio * stiffness_N_per_m * position_m;
  }

  /// Of the joint; position_m: how far this muscle has contracted.
  double angle_rad(double position_m) const { return lever.angle_rad(direction * position_m); }
  double position_m(double angle_rad) const { return direction * lever.arc_m(angle_rad); }
  /// Of what a sensor of the angle reads: the angle times the lever at 0, with the muscle's sign.
  double position_of_reading_m(double reading_m) const {
    const bool as_read = direction == 0 || lever.is_constant();
    return as_read ? reading_m : position_m(direction * reading_m / lever.zero_radius_m());
  }
  double reading_of_position_m(double position_m) const {
    const bool as_read = direction == 0 || lever.is_constant();
    return as_read ? position_m : direction * angle_rad(position_m) * lever.zero_radius_m();
  }
};

/// The bundle that a channel's muscle pulls in, if it does.
struct PlaceInBundle {
  bool bundled = false;
  /// From this channel to the one that leads it; NaN: it leads, or there is no bundle.
  double leader_offset = NAN;

  bool follows() const { return std::isfinite(leader_offset); }
};

/// What a simulation knows of its muscle and no board does: for what is told beforehand. Nothing in
/// a tick goes by it.
struct SimulatedTruth {
  double load_N = 0.0;  ///< that pulls the muscle longer than it is described to be
  bool linear = false;  ///< the linear model leaves nothing unexplained
};

struct ChannelSettings {
  control::PhysicalParameters muscle;  ///< as believed: configured, or learned before
  std::optional<control::PhysicalParameters> configured_muscle;  ///< empty: it is muscle
  bool has_muscle = false;         ///< it and the calibration were learned before
  bool muscle_identified = false;  ///< it was identified: not only believed
  board::Calibration calibration;  ///< its cold resistance is HeaterSettings' when not learned
  board::SenseComparison senses;   ///< with a meter, as stored
  board::ThermalFacts heat;        ///< found out before, as stored
  double response_ratio = 0.0;     ///< likewise, of small motions; 0: not measured
  double unexplained_ratio = 0.0;  ///< likewise, by the linear model; 0: not measured
  board::Identification identification{};  ///< likewise, of the muscle
  SimulatedTruth simulated{};
  board::StoredTuning tuning;  ///< as stored; controllers have it already
  PlaceInJoint joint;          ///< by add_joint()
  PlaceInBundle bundle;        ///< by add_bundle()
  InputSettings position;
  HeaterSettings heater;
  board::ThermalSettings thermal;
  LimiterSettings limiter;
  ChannelSupervision supervision;
  /// At least one of each; commands choose among them by their place.
  std::vector<control::ControllerSettings> controllers{1};
  std::vector<control::EstimatorSettings> estimators{1};
  /// Without what is stored of their tuning; empty: as they are.
  std::vector<control::ControllerSettings> configured_controllers;
  std::vector<control::EstimatorSettings> configured_estimators;
};

/// Two channels whose muscles turn one joint against each other. Positions of both are how far the
/// muscles have contracted, arcs at their levers: the antagonist's has the other sign.
struct JointSettings {
  std::size_t agonist = 0;     ///< its channel; turns the joint towards positive positions
  std::size_t antagonist = 1;  ///< its channel
  control::Lever lever{};      ///< of the agonist
  /// The power of the agonist while the joint asks for no effort; the antagonist's has the same
  /// effect. By it they pull against each other.
  double co_contraction_W = 1.0;
  /// Of what both heaters can give, where nothing else is said: with half of it the joint can still
  /// be asked for every effort.
  static constexpr double usual_limit_ratio = 0.5;
  /// That may be commanded, likewise in watts of the agonist.
  double max_co_contraction_W = std::numeric_limits<double>::infinity();
  double antagonist_lever_ratio = 1.0;  ///< of its lever to the agonist's, at every angle
  double pretension_N = NAN;  ///< of the agonist, both cold, at the angle 0; NaN: not known
  /// Of the joint's stiffness, that of the agonist and of the antagonist; a spring has the rest.
  /// Empty: they are alike.
  std::optional<std::array<double, 2>> stiffness_ratio{};

  std::array<double, 2> stiffness_ratios() const {
    const double q2 = antagonist_lever_ratio * antagonist_lever_ratio;
    return stiffness_ratio.value_or(std::array{1.0 / (1.0 + q2), q2 / (1.0 + q2)});
  }
  control::Lever antagonist_lever() const { return lever.scaled(antagonist_lever_ratio); }
  /// By so much a watt of the antagonist turns the joint further than one of the agonist; of their
  /// DC gains, each in metres of its own.
  double gain_ratio(double agonist_m_per_W, double antagonist_m_per_W) const {
    return antagonist_m_per_W / agonist_m_per_W / antagonist_lever_ratio;
  }
  /// Of the muscles as they are configured or were learned. channels: the board's.
  double gain_ratio(const std::vector<ChannelSettings>& channels) const {
    return gain_ratio(channels[agonist].muscle.dc_gain_m_per_W(),
                      channels[antagonist].muscle.dc_gain_m_per_W());
  }
  /// channel: any of the board's.
  PlaceInJoint place_of(std::size_t channel) const;
};

/// By its joint's agonist or its bundle's leader: its own controllers are not used.
inline bool is_led(const ChannelSettings& channel) {
  return channel.joint.direction < 0 || channel.bundle.follows();
}

/// Channels whose equal muscles pull the same thing. Every heater gets the same power; to its
/// controllers the bundle is one muscle, of which that power is the input.
struct BundleSettings {
  std::vector<std::size_t> channels;  ///< at least two. The first one leads: it has the sensor

  std::size_t leader() const { return channels.front(); }
};

struct BoardSettings {
  double rate_Hz = 1000.0;
  InputSettings supply;
  InputSettings air;  ///< in °C, where there is a sensor
  BoardSupervision supervision;
  std::vector<ChannelSettings> channels{1};
  std::vector<JointSettings> joints;    ///< see add_joint()
  std::vector<BundleSettings> bundles;  ///< see add_bundle(). No channel is in two of either

  double step_s() const { return 1.0 / rate_Hz; }
  /// The joint that this channel's muscle turns; null: none.
  const JointSettings* joint_of(std::size_t channel) const;
  /// The bundle that this channel's muscle pulls in; null: none.
  const BundleSettings* bundle_of(std::size_t channel) const;
};

/// The co-contraction that both heaters can give, by what is configured of the muscles.
double feasible_co_contraction_W(const BoardSettings& board, const JointSettings& joint);

/// Of two channels that the board has. The proof of response is for one muscle that moves alone: of
/// theirs none is asked.
void add_joint(BoardSettings& board, const JointSettings& joint);

/// Of channels that the board has. One muscle's dither is not seen beside the others: what follows
/// is not asked for a proof of response, and the leader's is the whole bundle's.
void add_bundle(BoardSettings& board, const BundleSettings& bundle);

/// What a channel learned before, in place of what is configured.
void apply_learned(ChannelSettings& channel, const board::Learned& learned);

/// From the sampling of a position, which may be a tick old, until the power acts that answers it.
inline double loop_delay_s(const ChannelSettings& channel, double step_s) {
  return step_s + channel.heater.delay_s;
}

/// The true power of a channel, from what its senses and its calibration may be wrong by.
board::PowerBounds power_bounds(const ChannelSettings& channel, const BoardSettings& board);

/// The room that a controller leaves on the channel's muscle, when it has adapted to it if it
/// adapts. Empty: it works in open loop.
std::optional<control::LoopMargin> margin_of(const control::ControllerSettings& controller,
                                             const ChannelSettings& channel, double step_s);

/// What the proof that the muscle answers rests on.
ProofSettings proof_settings(const ChannelSettings& channel, const BoardSettings& board);

struct SettingsProblem {
  std::string key;  ///< of [board] or of the controller; empty: of the board as a whole
  std::string message;
};

/// All that is wrong with a law whatever its muscle: also an arithmetic that it does not run in.
/// MRAC's premises are among it, unless it was accepted that they fail.
std::vector<SettingsProblem> contradictions(const control::ControllerSettings& controller);
/// Of an estimator: no kind that there is, or an arithmetic that it does not run in.
std::vector<SettingsProblem> contradictions(const control::EstimatorSettings& estimator);

/// In words, what q8.24 cannot hold.
std::string misfit_text(const control::Violation& misfit);

/// Why a controller may not run on this channel: its own contradictions, what q8.24 cannot hold, or
/// a loop that is unstable on the channel's muscle even when it has adapted to it.
std::optional<SettingsProblem> check(const control::ControllerSettings& controller,
                                     const ChannelSettings& channel, double step_s);

/// Why an estimator may not run on this channel: its own contradictions, or what q8.24 cannot hold.
std::optional<SettingsProblem> check(const control::EstimatorSettings& estimator,
                                     const ChannelSettings& channel, double step_s);

/// Stored tuning that may not run on this channel any more, for the first reason that is told: its
/// controllers and estimators are as configured then.
std::optional<SettingsProblem> drop_unusable_tuning(ChannelSettings& channel, double step_s);

/// What makes settings unusable whoever wrote them; empty when they may run. (Ranges of single
/// values are the configuration's to check.)
std::optional<SettingsProblem> check(const BoardSettings& settings);

}  // namespace supercoil
