#include "loop/settings.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace supercoil {

namespace {

template <class Settings, std::size_t Places>
void apply_values(const std::array<board::StoredValues, Places>& stored, std::vector<Settings>& all,
                  std::vector<Settings>& configured) {
  configured = all;
  for (std::size_t place = 0; place < std::min(all.size(), Places); ++place)
    stored[place].apply_to(all[place]);
}

void apply_tuning(ChannelSettings& channel, const board::StoredTuning& tuning) {
  channel.tuning = tuning;
  if (tuning == board::StoredTuning{}) return;
  apply_values(tuning.controllers, channel.controllers, channel.configured_controllers);
  apply_values(tuning.estimators, channel.estimators, channel.configured_estimators);
}

template <class Settings>
std::optional<SettingsProblem> first_problem(const std::vector<Settings>& all,
                                             const ChannelSettings& channel, double step_s) {
  for (const Settings& one : all) {
    if (auto problem = check(one, channel, step_s)) return problem;
  }
  return std::nullopt;
}

template <class Settings, class Names>
std::vector<SettingsProblem> problems_of_arithmetic(const Settings& settings, const Names& names) {
  if (control::supported(settings.kind, settings.arithmetic)) return {};
  return {{"arithmetic", "must be double or float: the covariance of " +
                             std::string(control::name_of(names, settings.kind)) +
                             " does not fit q8.24"}};
}

/// Checks and takes a channel for a joint or a bundle.
std::optional<SettingsProblem> take(const BoardSettings& settings, const char* key,
                                    std::size_t channel, std::set<std::size_t>& taken) {
  const std::string number = std::to_string(channel + 1);
  if (channel >= settings.channels.size()) {
    return SettingsProblem{key, "channel " + number + " is not one of the board's " +
                                    std::to_string(settings.channels.size())};
  }
  if (!taken.insert(channel).second)
    return SettingsProblem{key, "channel " + number + " is used twice"};
  return std::nullopt;
}

SettingsProblem cannot_prove(const char* key, std::size_t channel) {
  return {key,
          "channel " + std::to_string(channel + 1) + " cannot prove by itself that it responds"};
}

/// Each joint takes two channels that no other joint has.
std::optional<SettingsProblem> check_joints(const BoardSettings& settings,
                                            std::set<std::size_t>& taken) {
  for (const JointSettings& joint : settings.joints) {
    for (const std::size_t channel : {joint.agonist, joint.antagonist}) {
      if (auto problem = take(settings, "joint", channel, taken)) return problem;
      if (settings.channels[channel].supervision.proof_of_response)
        return cannot_prove("joint", channel);
    }
    const auto positive = [](double radius_m) { return radius_m > 0.0; };
    if (!std::ranges::all_of(joint.antagonist_lever().radii_m(), positive) ||
        !std::ranges::all_of(joint.lever.radii_m(), positive) || !(joint.co_contraction_W >= 0.0))
      return SettingsProblem{"joint", "lever_m must exceed 0, and co_contraction_W be 0 or more"};
    if (!(joint.co_contraction_W <= joint.max_co_contraction_W))
      return SettingsProblem{"joint", "co_contraction_W must not exceed max_co_contraction_W"};
  }
  return std::nullopt;
}

/// A setting that the bundle's leader determines for all: travel, proof and ramps are the bundle's.
struct SharedSetting {
  const char* key;
  double leaders;
  double followers;
  bool may_be_more;  ///< for the follower
};

/// What contradicts the leader; empty: nothing.
std::string contradiction(const ChannelSettings& leader, const ChannelSettings& follower) {
  const control::ThermalBounds& of_leader = leader.thermal.bounds;
  const control::ThermalBounds& of_follower = follower.thermal.bounds;
  for (const SharedSetting& one :
       {SharedSetting{"limits.max_travel_m", leader.supervision.max_travel_m,
                      follower.supervision.max_travel_m, true},
        {"limits.trip_C", leader.supervision.trip_C, follower.supervision.trip_C, true},
        {"limits.derate_from_C", leader.limiter.derate_from_C, follower.limiter.derate_from_C,
         true},
        {"thermal.min_mass_J_per_K", of_leader.min_mass_J_per_K, of_follower.min_mass_J_per_K,
         true},
        {"thermal.min_transfer_W_per_K", of_leader.min_transfer_W_per_K,
         of_follower.min_transfer_W_per_K, true},
        {"limits.min_W", leader.limiter.min_W, follower.limiter.min_W, false},
        {"limits.slew_W_per_s", leader.limiter.slew_W_per_s, follower.limiter.slew_W_per_s,
         false}}) {
    if (one.followers < one.leaders) return std::string(one.key) + " is less than";
    if (one.followers > one.leaders && !one.may_be_more)
      return std::string(one.key) + " is more than";
  }
  return "";
}

/// Each bundle takes at least two channels, which are in no joint.
std::optional<SettingsProblem> check_bundles(const BoardSettings& settings,
                                             std::set<std::size_t>& taken) {
  for (const BundleSettings& bundle : settings.bundles) {
    if (bundle.channels.size() < 2)
      return SettingsProblem{"bundle", "channels must be at least two"};
    for (const std::size_t channel : bundle.channels) {
      if (auto problem = take(settings, "bundle", channel, taken)) return problem;
      const ChannelSettings& c = settings.channels[channel];
      if (c.bundle.follows() && c.supervision.proof_of_response)
        return cannot_prove("bundle", channel);
      const std::string why = contradiction(settings.channels[bundle.leader()], c);
      if (!why.empty()) {
        return SettingsProblem{"bundle", "channel " + std::to_string(channel + 1) + "'s " + why +
                                             " that of channel " +
                                             std::to_string(bundle.leader() + 1) +
                                             ", which leads; set what they share in "
                                             "[every_channel]"};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

const JointSettings* BoardSettings::joint_of(std::size_t channel) const {
  const auto found = std::ranges::find_if(joints, [channel](const JointSettings& joint) {
    return joint.agonist == channel || joint.antagonist == channel;
  });
  return found == joints.end() ? nullptr : &*found;
}

const BundleSettings* BoardSettings::bundle_of(std::size_t channel) const {
  const auto found = std::ranges::find_if(bundles, [channel](const BundleSettings& bundle) {
    return std::ranges::find(bundle.channels, channel) != bundle.channels.end();
  });
  return found == bundles.end() ? nullptr : &*found;
}

double feasible_co_contraction_W(const BoardSettings& board, const JointSettings& joint) {
  const ChannelSettings& agonist = board.channels[joint.agonist];
  const ChannelSettings& antagonist = board.channels[joint.antagonist];
  return std::min(agonist.limiter.max_W,
                  joint.gain_ratio(board.channels) * antagonist.limiter.max_W);
}

PlaceInJoint JointSettings::place_of(std::size_t channel) const {
  const double apart = static_cast<double>(antagonist) - static_cast<double>(agonist);
  const auto [first, second] = stiffness_ratios();
  if (channel == agonist) return {1, lever, apart, pretension_N, first};
  if (channel == antagonist)
    return {-1, antagonist_lever(), -apart, pretension_N / antagonist_lever_ratio, second};
  return {};
}

void add_joint(BoardSettings& board, const JointSettings& joint) {
  board.joints.push_back(joint);
  for (const std::size_t channel : {joint.agonist, joint.antagonist}) {
    board.channels[channel].joint = joint.place_of(channel);
    board.channels[channel].supervision.proof_of_response = false;
  }
}

void add_bundle(BoardSettings& board, const BundleSettings& bundle) {
  board.bundles.push_back(bundle);
  const auto leader = static_cast<double>(bundle.leader());
  for (const std::size_t channel : bundle.channels) {
    board.channels[channel].bundle = {true, NAN};
    if (channel == bundle.leader()) continue;
    board.channels[channel].bundle.leader_offset = leader - static_cast<double>(channel);
    board.channels[channel].supervision.proof_of_response = false;
  }
}

void apply_learned(ChannelSettings& channel, const board::Learned& learned) {
  channel.senses = learned.senses;
  channel.heat = learned.heat;
  apply_tuning(channel, learned.tuning);
  channel.has_muscle = learned.has_muscle;
  if (!channel.has_muscle) return;
  // Calibrate alone stores the muscle as configured: that is not an identification.
  channel.muscle_identified = !(learned.muscle == channel.muscle);
  channel.configured_muscle = channel.muscle;
  channel.muscle = learned.muscle;
  channel.calibration = learned.calibration;
  channel.response_ratio = learned.response_ratio;
  channel.unexplained_ratio = learned.unexplained_ratio;
  channel.identification = learned.identification;
}

std::optional<control::LoopMargin> margin_of(const control::ControllerSettings& controller,
                                             const ChannelSettings& channel, double step_s) {
  const auto law = control::fixed_law(controller, channel.muscle);
  if (!law) return std::nullopt;
  return control::loop_margin(*law, channel.muscle, step_s, loop_delay_s(channel, step_s));
}

board::PowerBounds power_bounds(const ChannelSettings& channel, const BoardSettings& board) {
  board::PowerBounds bounds({.min_supply_V = board.supervision.min_supply_V,
                             .max_supply_V = board.supervision.max_supply_V,
                             .resistance_tolerance_ratio = channel.supervision.resistance_ratio,
                             .current_noise_A = channel.supervision.current_noise_A,
                             .max_W = channel.limiter.max_W,
                             .min_power_ratio = channel.thermal.min_power_ratio,
                             .max_power_ratio = channel.thermal.max_power_ratio});
  bounds.set(channel.senses);
  return bounds;
}

ProofSettings proof_settings(const ChannelSettings& c, const BoardSettings& board) {
  ProofSettings s;
  s.enabled = c.supervision.proof_of_response;
  s.thermal = c.thermal;
  s.max_power_ratio = power_bounds(c, board).true_over_measured().max;
  s.max_W = c.limiter.max_W;
  s.derate_from_C = c.limiter.derate_from_C;
  s.trip_C = c.supervision.trip_C;
  s.position_noise_rms_m = c.supervision.position_noise_rms_m;
  s.count_m = std::abs(c.position.scaling.per_count);
  s.obvious_m = c.supervision.responding_min_m;
  if (c.response_ratio > 0.0) s.response_ratio = c.response_ratio;
  return s;
}

std::vector<SettingsProblem> contradictions(const control::ControllerSettings& controller) {
  auto problems = problems_of_arithmetic(controller, control::controller_names);
  for (const auto& [key, message, premise] : control::contradictions_of_law(controller)) {
    problems.push_back({key, premise ? std::string("premise fails: ") + message +
                                           " (accept_failed_premises = true runs it anyway)"
                                     : std::string(message)});
  }
  return problems;
}

std::vector<SettingsProblem> contradictions(const control::EstimatorSettings& estimator) {
  if (static_cast<std::size_t>(estimator.kind) >= control::estimator_names.size())
    return {{"kind", "is not a kind of estimator"}};
  return problems_of_arithmetic(estimator, control::estimator_names);
}

std::string misfit_text(const control::Violation& misfit) {
  std::ostringstream message;
  message << "does not fit arithmetic = \"q8.24\": it is stored as " << misfit.value
          << " there, and must be " << misfit.min << " to " << misfit.max;
  return message.str();
}

std::optional<SettingsProblem> check(const control::ControllerSettings& controller,
                                     const ChannelSettings& channel, double step_s) {
  if (const auto problems = contradictions(controller); !problems.empty()) return problems.front();
  if (const auto misfit = control::check_fit(controller, step_s, channel.supervision.max_travel_m,
                                             channel.limiter.max_W))
    return SettingsProblem{misfit->quantity, misfit_text(*misfit)};
  const auto margin = margin_of(controller, channel, step_s);
  if (!margin || margin->stable()) return std::nullopt;
  std::string_view change;
  control::with_chosen<control::Laws>(
      controller, [&](auto law, const auto&) { change = decltype(law)::when_unstable; });
  std::ostringstream message;
  message << "is unstable on this muscle"
          << (control::adapts(controller.kind) ? ", even when adapted," : "") << " with "
          << 1e3 * loop_delay_s(channel, step_s) << " ms of delay: " << change
          << ", or shorten the delay";
  return SettingsProblem{"kind", message.str()};
}

std::optional<SettingsProblem> check(const control::EstimatorSettings& estimator,
                                     const ChannelSettings& channel, double step_s) {
  if (const auto problems = contradictions(estimator); !problems.empty()) return problems.front();
  const auto misfit = control::check_fit(estimator, step_s, channel.limiter.max_W);
  if (!misfit) return std::nullopt;
  return SettingsProblem{misfit->quantity, misfit_text(*misfit)};
}

std::optional<SettingsProblem> drop_unusable_tuning(ChannelSettings& channel, double step_s) {
  if (channel.configured_controllers.empty()) return std::nullopt;
  auto problem = first_problem(channel.controllers, channel, step_s);
  if (!problem) problem = first_problem(channel.estimators, channel, step_s);
  if (!problem) return std::nullopt;
  channel.controllers = channel.configured_controllers;
  channel.estimators = channel.configured_estimators;
  return problem;
}

std::optional<SettingsProblem> check(const BoardSettings& settings) {
  const BoardSupervision& s = settings.supervision;
  const std::size_t channels = settings.channels.size();
  if (channels < 1 || channels > 16)
    return SettingsProblem{"", "a board has 1 to 16 channels, not " + std::to_string(channels)};
  const double tolerated_s = s.overruns_in_a_row * settings.step_s();
  if (!(s.charge_pump_decay_s > 2.0 * tolerated_s)) {
    std::ostringstream message;
    message << "must exceed twice the tolerated overruns: " << s.overruns_in_a_row
            << " in a row at " << settings.rate_Hz << " Hz are " << 1e3 * tolerated_s
            << " ms, so more than " << 2e3 * tolerated_s << " ms, not "
            << 1e3 * s.charge_pump_decay_s;
    return SettingsProblem{"charge_pump_decay_ms", message.str()};
  }
  for (const ChannelSettings& channel : settings.channels) {
    if (channel.controllers.empty() || channel.estimators.empty())
      return SettingsProblem{"", "a channel needs a controller and an estimator"};
  }
  std::set<std::size_t> taken;
  if (auto problem = check_joints(settings, taken)) return problem;
  return check_bundles(settings, taken);
}

}  // namespace supercoil
