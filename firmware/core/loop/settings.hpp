// The board settings that the loop needs, in SI units, checked before it starts.
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

/// The heater, as the power stage and its measurement treat it.
struct HeaterSettings {
  InputSettings current;
  double sense_filter_s = 0.0;  ///< time constant of the averaging current sense; 0: a tick's mean
  double resistance_filter_s = 0.2;  ///< smoothing of the measured resistance
  double cold_resistance_Ohm = 10.0;
  double temperature_coefficient_per_K = 0.0;  ///< of the resistance; 0: no temperature from it
  double probe_duty = 0.02;                    ///< at most 0.02
  double probe_s = 0.05;                       ///< at most 0.05
  double probe_every_s = 5.0;  ///< while hot below probe_duty: resistance age for a new probe
  bool error_feedback = true;  ///< of the duty's rounding
  int pwm_steps = 4095;        ///< per period, as the output has them
  double delay_s = 0.0;        ///< from setting a duty until it acts
};

/// The joint that a channel's muscle turns.
struct PlaceInJoint {
  int direction = 0;  ///< the joint turns with (1) or against (-1) the position; 0: no joint
  control::Lever lever{};
  /// The other muscle's channel, counted from this one: 1 is the next. NaN: only a spring or a
  /// weight also turns the joint.
  double other_channel_offset = NAN;
  double pretension_N = NAN;     ///< its pull, cold and at the angle 0; NaN: not known
  double stiffness_ratio = 0.5;  ///< the muscle's own share of the stiffness in its parameters
  double weight_Nm = 0.0;     ///< of the arm that alone draws it back, when level; 0: no such arm
  double hangs_at_rad = 0.0;  ///< angle at which that arm would hang without the muscle; at most 0

  bool turns() const { return direction != 0; }
  bool has_other() const { return std::isfinite(other_channel_offset); }

  bool weighs() const { return weight_Nm > 0.0; }

  bool knows_pull() const { return std::isfinite(pretension_N); }
  /// The cold muscle's pull at this contraction; negative: it is slack. stiffness_N_per_m: as in
  /// its parameters.
  double cold_pull_N(double position_m, double stiffness_N_per_m) const {
    return pretension_N - stiffness_ratio * stiffness_N_per_m * position_m;
  }

  /// The joint's angle. position_m: contraction of this muscle.
  double angle_rad(double position_m) const { return lever.angle_rad(direction * position_m); }
  /// Inverts angle_rad().
  double position_m(double angle_rad) const { return direction * lever.arc_m(angle_rad); }
  /// reading_m: from a sensor of the angle: the angle times the lever at 0, with the muscle's sign.
  double position_of_reading_m(double reading_m) const {
    const bool as_read = direction == 0 || lever.is_constant();
    return as_read ? reading_m : position_m(direction * reading_m / lever.zero_radius_m());
  }
  /// Inverts position_of_reading_m().
  double reading_of_position_m(double position_m) const {
    const bool as_read = direction == 0 || lever.is_constant();
    return as_read ? position_m : direction * angle_rad(position_m) * lever.zero_radius_m();
  }
};

/// The bundle in which a channel's muscle pulls, if any.
struct PlaceInBundle {
  bool bundled = false;
  /// The leader's channel, counted from this one; NaN: this one leads, or there is no bundle.
  double leader_offset = NAN;

  bool follows() const { return std::isfinite(leader_offset); }
};

/// What only a simulation knows of its muscle, for predictions before a run. No tick uses it.
struct SimulatedTruth {
  double load_N = 0.0;  ///< stretches the muscle beyond its described length
  bool linear = false;  ///< the linear model explains everything
};

/// Everything that a channel needs to know of its muscle, heater, limits and control.
struct ChannelSettings {
  control::PhysicalParameters muscle;  ///< as believed: configured, or learned before
  std::optional<control::PhysicalParameters> configured_muscle;  ///< empty: same as muscle
  bool has_muscle = false;         ///< muscle and calibration were learned before
  bool muscle_identified = false;  ///< identified, not only believed
  board::Calibration calibration;  ///< unless learned, its cold resistance is HeaterSettings'
  board::SenseComparison senses;   ///< comparison with a meter, as stored
  board::ThermalFacts heat;        ///< learned before, as stored
  double response_ratio = 0.0;     ///< likewise, of small motions; 0: not measured
  double unexplained_ratio = 0.0;  ///< likewise, by the linear model; 0: not measured
  board::Identification identification{};  ///< likewise, of the muscle
  SimulatedTruth simulated{};
  board::StoredTuning tuning;  ///< as stored; already in controllers and estimators
  PlaceInJoint joint;          ///< by add_joint()
  PlaceInBundle bundle;        ///< by add_bundle()
  InputSettings position;
  HeaterSettings heater;
  board::ThermalSettings thermal;
  LimiterSettings limiter;
  ChannelSupervision supervision;
  /// At least one of each; commands choose them by their place.
  std::vector<control::ControllerSettings> controllers{1};
  std::vector<control::EstimatorSettings> estimators{1};
  /// The same without the stored tuning; empty: no difference.
  std::vector<control::ControllerSettings> configured_controllers;
  std::vector<control::EstimatorSettings> configured_estimators;

  /// As configured, also after another one was learned.
  const control::PhysicalParameters& file_muscle() const {
    return configured_muscle ? *configured_muscle : muscle;
  }
};

/// Two channels whose muscles turn one joint against each other. Each position is that muscle's
/// contraction, an arc at its lever; the antagonist's has the opposite sign.
struct JointSettings {
  std::size_t agonist = 0;     ///< its channel; turns the joint towards positive positions
  std::size_t antagonist = 1;  ///< its channel
  control::Lever lever{};      ///< of the agonist
  /// The agonist's power while the joint asks for no effort; the antagonist's has the same effect.
  /// With it they pull against each other.
  double co_contraction_W = 1.0;
  /// Default of max_co_contraction_W over what both heaters can give: with half of it the joint can
  /// still be asked for every effort.
  static constexpr double default_limit_ratio = 0.5;
  /// The maximum that may be commanded, also in watts of the agonist.
  double max_co_contraction_W = std::numeric_limits<double>::infinity();
  double antagonist_lever_ratio = 1.0;  ///< of its lever to the agonist's, at every angle
  double pretension_N = NAN;  ///< of the agonist, both cold, at the angle 0; NaN: not known
  /// The shares of the agonist and of the antagonist in the joint's stiffness; a spring has the
  /// rest. Empty: the muscles are alike.
  std::optional<std::array<double, 2>> stiffness_ratio{};

  std::array<double, 2> stiffness_ratios() const {
    const double q2 = antagonist_lever_ratio * antagonist_lever_ratio;
    return stiffness_ratio.value_or(std::array{1.0 / (1.0 + q2), q2 / (1.0 + q2)});
  }
  control::Lever antagonist_lever() const { return lever.scaled(antagonist_lever_ratio); }
  /// Joint motion per watt of the antagonist over that per watt of the agonist. Arguments: their DC
  /// gains, each in the muscle's own metres.
  double gain_ratio(double agonist_m_per_W, double antagonist_m_per_W) const {
    return antagonist_m_per_W / agonist_m_per_W / antagonist_lever_ratio;
  }
  /// For the muscles as configured or learned. channels: the board's.
  double gain_ratio(const std::vector<ChannelSettings>& channels) const {
    return gain_ratio(channels[agonist].muscle.dc_gain_m_per_W(),
                      channels[antagonist].muscle.dc_gain_m_per_W());
  }
  /// channel: any channel of the board.
  PlaceInJoint place_of(std::size_t channel) const;
};

/// Whether the joint's agonist or the bundle's leader leads it: its own controllers are not used.
inline bool is_led(const ChannelSettings& channel) {
  return channel.joint.direction < 0 || channel.bundle.follows();
}

/// Channels whose equal muscles pull the same load. Every heater gets the same power; the
/// controllers see the bundle as one muscle with that power as input.
struct BundleSettings {
  std::vector<std::size_t> channels;  ///< at least two. The first leads and has the sensor

  std::size_t leader() const { return channels.front(); }
};

/// What Loop runs; must pass check().
struct BoardSettings {
  double rate_Hz = 1000.0;
  InputSettings supply;
  InputSettings air;  ///< in °C, where there is a sensor
  BoardSupervision supervision;
  std::vector<ChannelSettings> channels{1};
  std::vector<JointSettings> joints;    ///< see add_joint()
  std::vector<BundleSettings> bundles;  ///< see add_bundle(). No channel is in two of these

  double step_s() const { return 1.0 / rate_Hz; }
  /// The joint that this channel's muscle turns; null: none.
  const JointSettings* joint_of(std::size_t channel) const;
  /// The bundle in which this channel's muscle pulls; null: none.
  const BundleSettings* bundle_of(std::size_t channel) const;
};

/// The maximum co-contraction that both heaters can give, for the muscles as configured or learned.
double feasible_co_contraction_W(const BoardSettings& board, const JointSettings& joint);

/// The board must have both channels. No proof of response is asked of them: it needs a muscle that
/// moves alone.
void add_joint(BoardSettings& board, const JointSettings& joint);

/// The board must have these channels. One muscle's dither is not seen beside the others: a
/// follower needs no proof of response, and the leader's is the whole bundle's.
void add_bundle(BoardSettings& board, const BundleSettings& bundle);

/// Replaces configured values by those that the channel learned before.
void apply_learned(ChannelSettings& channel, const board::Learned& learned);

/// From sampling a position, which may be a tick old, until the power that responds to it acts.
inline double loop_delay_s(const ChannelSettings& channel, double step_s) {
  return step_s + channel.heater.delay_s;
}

/// Bounds of a channel's true power, from the errors of its senses and calibration.
board::PowerBounds power_bounds(const ChannelSettings& channel, const BoardSettings& board);

/// The margin of a controller's loop on the channel's muscle; an adaptive controller is taken as
/// adapted. Empty: it works in open loop.
std::optional<control::LoopMargin> margin_of(const control::ControllerSettings& controller,
                                             const ChannelSettings& channel, double step_s);

/// Settings of the channel's proof of response.
ProofSettings proof_settings(const ChannelSettings& channel, const BoardSettings& board);

/// Why settings cannot be used.
struct SettingsProblem {
  std::string key;  ///< of [board] or of the controller; empty: of the board as a whole
  std::string message;
};

/// Everything that is wrong with a law whatever its muscle, including an arithmetic that it does
/// not support and MRAC's failed premises, unless the settings accept those.
std::vector<SettingsProblem> contradictions(const control::ControllerSettings& controller);
/// For an estimator: an unknown kind, or an arithmetic that it does not support.
std::vector<SettingsProblem> contradictions(const control::EstimatorSettings& estimator);

/// A message about the value that q8.24 cannot hold.
std::string misfit_text(const control::Violation& misfit);

/// Why a controller may not run on this channel: its own contradictions, what q8.24 cannot hold, or
/// a loop that is unstable on the channel's muscle even when it has adapted to it.
std::optional<SettingsProblem> check(const control::ControllerSettings& controller,
                                     const ChannelSettings& channel, double step_s);

/// Why an estimator may not run on this channel: its own contradictions, or what q8.24 cannot hold.
std::optional<SettingsProblem> check(const control::EstimatorSettings& estimator,
                                     const ChannelSettings& channel, double step_s);

/// Drops stored tuning that can no longer run on this channel: its controllers and estimators are
/// then as configured. Returns the first reason.
std::optional<SettingsProblem> drop_unusable_tuning(ChannelSettings& channel, double step_s);

/// Why settings are unusable, whatever their source; empty: they can run. (The configuration checks
/// the ranges of single values.)
std::optional<SettingsProblem> check(const BoardSettings& settings);

}  // namespace supercoil
