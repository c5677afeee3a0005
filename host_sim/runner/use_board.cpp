#include "runner/use_board.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

namespace supercoil::host_sim {

namespace {

using OrRefused = Result<void>;

Result<void> refuse(const std::ostringstream& why) {
  return failure(why.str());
}

OrRefused check_supply(const Conditions& c, const BoardSettings& board) {
  const BoardSupervision& s = board.supervision;
  if (c.power.supply_V >= s.min_supply_V && c.power.supply_V <= s.max_supply_V) return {};
  std::ostringstream why;
  why << "the scenario's power.supply_V = " << c.power.supply_V << " is outside the board's "
      << "supply.min_V to max_V, " << s.min_supply_V << " to " << s.max_supply_V;
  return refuse(why);
}

/// Commands select other controllers by their place in the scenario.
OrRefused check_events(const Scenario& scenario) {
  for (const Event& event : scenario.events) {
    if (!event.new_controller && !event.new_estimator) continue;
    std::ostringstream why;
    why << "the scenario's event at " << event.at_s << " s changes ["
        << (event.new_controller ? "controller" : "estimator")
        << "], but the board's file has its own; remove that table";
    return refuse(why);
  }
  return {};
}

/// Position and power of the file, as the firmware limits them, for the scenario's operator.
void put(Conditions& c, const ChannelSettings& channel, const config::ChannelWiring& wiring) {
  PositionSensorSettings& sensor = c.position_sensor;
  sensor.noise_rms_m = channel.supervision.position_noise_rms_m;
  sensor.min_m = channel.supervision.min_position_m;
  sensor.range_m = channel.supervision.max_position_m;
  sensor.count_m = std::abs(channel.position.scaling.per_count);
  sensor.rate_Hz = 0.0;
  c.ambient.sensor_error_K = channel.thermal.air.error_K;
  c.power.pwm_steps = wiring.pwm.steps;
  c.power.delay_s = channel.heater.delay_s;
  c.power.max_W = channel.limiter.max_W;
  c.power.min_W = channel.limiter.min_W;
  c.controller = channel.controllers.front();
  c.muscle = channel.muscle;
}

/// Like put(), for the antagonist. scenario_W: co-contraction at the scenario's start, which the
/// file's replaces; a different one from an event is kept.
OrRefused put_antagonist(Conditions& c, const BoardSettings& board,
                         const config::ChannelWiring& wiring, double scenario_W) {
  AntagonistConditions& antagonist = *c.joint->antagonist;
  const JointSettings& joint = board.joints[0];
  antagonist.muscle = board.channels[1].muscle;
  antagonist.pwm_steps = wiring.pwm.steps;
  if (antagonist.co_contraction_W == scenario_W)
    antagonist.co_contraction_W = joint.co_contraction_W;
  if (antagonist.co_contraction_W <= joint.max_co_contraction_W) return {};
  std::ostringstream why;
  why << "an event's joint.co_contraction_W = " << antagonist.co_contraction_W
      << " is more than the board's max_co_contraction_W, " << joint.max_co_contraction_W;
  return refuse(why);
}

/// As it is written in a file.
std::string text_of(const control::Lever& lever) {
  std::ostringstream out;
  if (lever.is_constant()) {
    out << lever.zero_radius_m();
    return out.str();
  }
  constexpr double deg_per_rad = 180.0 / std::numbers::pi;
  for (const double radius_m : lever.radii_m())
    out << (out.tellp() == 0 ? "[" : ", ") << radius_m;
  out << "] over " << deg_per_rad * lever.first_rad() << " to " << deg_per_rad * lever.last_rad()
      << " deg";
  return out.str();
}

std::string other_lever(const control::Lever& scenarios, const control::Lever& boards) {
  return "the scenario's joint.lever_m = " + text_of(scenarios) + " is not the board's, " +
         text_of(boards) + ": positions are arc lengths at the lever";
}

/// The file's joint that matches the scenario's [joint]; empty: neither has one.
Result<std::optional<JointSettings>> find_joint(const Conditions& c, const BoardSettings& board,
                                                std::size_t channel) {
  const JointSettings* found = board.joint_of(channel);
  std::ostringstream why;
  const control::Lever* const turned = found == nullptr && board.channels[channel].joint.turns()
                                           ? &board.channels[channel].joint.lever
                                           : nullptr;
  if (c.antagonist() == nullptr && found == nullptr) {
    if (turned == nullptr || (c.joint && c.joint->plant.lever == *turned)) return std::nullopt;
    if (c.joint) return failure(other_lever(c.joint->plant.lever, *turned));
    const char* opposed_by = board.channels[channel].joint.weighs() ? "gravity" : "spring";
    why << "channel " << channel + 1 << " of the board's file turns a joint alone: the "
        << "scenario needs a [joint] with opposed_by = \"" << opposed_by << "\"";
    return failure(why.str());
  }
  if (c.antagonist() == nullptr) {
    why << "channel " << channel + 1 << " of the board's file turns a joint: the scenario needs a "
        << "[joint] with opposed_by = \"muscle\"";
    return failure(why.str());
  }
  if (found == nullptr) {
    why << "the scenario has a [joint] of two muscles, but channel " << channel + 1
        << " of the board's file is in no [[joint]]";
    return failure(why.str());
  }
  const control::Lever& lever = c.joint->plant.lever;
  if (found->lever != lever) return failure(other_lever(lever, found->lever));
  if (c.joint->plant.antagonist_lever_ratio != found->antagonist_lever_ratio) {
    why << "the scenario's joint.antagonist_lever_m = "
        << c.joint->plant.antagonist_lever_ratio * lever.zero_radius_m() << " is not the board's, "
        << found->antagonist_lever().zero_radius_m();
    return failure(why.str());
  }
  return *found;
}

/// The file's bundle that matches the scenario's [bundle]; empty: neither has one.
Result<std::optional<BundleSettings>> find_bundle(const Conditions& c, const BoardSettings& board,
                                                  std::size_t channel) {
  const BundleSettings* found = board.bundle_of(channel);
  const std::size_t expected = c.companions.size() + 1;
  const std::size_t actual = found == nullptr ? 1 : found->channels.size();
  if (expected == actual) return found == nullptr ? std::nullopt : std::optional(*found);
  std::ostringstream why;
  why << "channel " << channel + 1 << " of the board's file "
      << (found == nullptr ? "is in no [[bundle]]" : "is in a [[bundle]]");
  if (found != nullptr) why << " of " << actual << " muscles";
  why << ", but the scenario has " << (expected == 1 ? "no [bundle]" : "a [bundle]");
  if (expected > 1) why << " of " << expected;
  return failure(why.str());
}

/// The file's board with the scenario's channels only: the agonist, or a bundle's leader, first.
BoardSettings board_of_one(const BoardSettings& all, std::size_t channel,
                           std::optional<JointSettings> joint,
                           std::optional<BundleSettings> bundle) {
  std::vector<std::size_t> used{channel};
  if (joint) used = {joint->agonist, joint->antagonist};
  if (bundle) used = bundle->channels;
  BoardSettings board = all;
  board.joints.clear();
  board.bundles.clear();
  board.channels.clear();
  for (const std::size_t place : used)
    board.channels.push_back(all.channels[place]);
  if (joint) {
    joint->agonist = 0;
    joint->antagonist = 1;
    add_joint(board, *joint);
  }
  if (bundle) {
    std::iota(bundle->channels.begin(), bundle->channels.end(), std::size_t{0});
    add_bundle(board, *bundle);
  }
  return board;
}

}  // namespace

OrRefused use_board(Scenario& scenario, const config::BoardConfig& config, std::size_t channel,
                    const LearnedMuscles& learned) {
  if (auto checked = check_supply(scenario.start, config.settings); !checked) return checked;
  if (auto checked = check_events(scenario); !checked) return checked;
  const auto joint = find_joint(scenario.start, config.settings, channel);
  if (!joint) return tl::unexpected(joint.error());
  const auto bundle = find_bundle(scenario.start, config.settings, channel);
  if (!bundle) return tl::unexpected(bundle.error());
  if (*joint) channel = (*joint)->agonist;
  if (*bundle) channel = (*bundle)->leader();
  BoardSettings board = board_of_one(config.settings, channel, *joint, *bundle);
  for (std::size_t i = 0; i < board.channels.size(); ++i) {
    if (learned[i]) apply_learned(board.channels[i], *learned[i]);
  }
  scenario.rate_Hz = board.rate_Hz;
  if (config.can) scenario.can = *config.can;
  const std::size_t last = can::max_nodes + 1 - board.channels.size();
  scenario.can.first_node =
      static_cast<can::Node>(std::min(scenario.can.first_node + channel, last));
  put(scenario.start, board.channels[0], config.wiring.channels[channel]);
  for (Event& event : scenario.events)
    put(event.conditions, board.channels[0], config.wiring.channels[channel]);
  if (*joint) {
    const double scenario_W = scenario.start.antagonist()->co_contraction_W;
    const config::ChannelWiring& wiring = config.wiring.channels[(*joint)->antagonist];
    static_cast<void>(put_antagonist(scenario.start, board, wiring, scenario_W));
    for (Event& event : scenario.events) {
      if (auto put_in = put_antagonist(event.conditions, board, wiring, scenario_W); !put_in)
        return put_in;
    }
  }
  scenario.board = std::move(board);
  scenario.board_crc32 = config.crc32;
  return {};
}

}  // namespace supercoil::host_sim
