#include "runner/use_board.hpp"

#include <cmath>
#include <sstream>
#include <utility>

namespace supercoil::host_sim {

namespace {

using OrRefused = tl::expected<void, std::string>;

tl::expected<void, std::string> refuse(const std::ostringstream& why) {
  return tl::unexpected(why.str());
}

OrRefused check_supply(const Conditions& c, const BoardSettings& board) {
  const BoardSupervision& s = board.supervision;
  if (c.power.supply_V >= s.min_supply_V && c.power.supply_V <= s.max_supply_V) return {};
  std::ostringstream why;
  why << "the scenario's power.supply_V = " << c.power.supply_V << " is outside of the board's "
      << "supply.min_V to max_V, " << s.min_supply_V << " to " << s.max_supply_V;
  return refuse(why);
}

/// The commands that ask for other controllers know them by their place in the scenario.
OrRefused check_events(const Scenario& scenario) {
  for (const Event& event : scenario.events) {
    if (!event.new_controller && !event.new_estimator) continue;
    std::ostringstream why;
    why << "the scenario's event at " << event.at_s << " s changes ["
        << (event.new_controller ? "controller" : "estimator")
        << "], and the board's file has its own; leave that table out";
    return refuse(why);
  }
  return {};
}

/// The scenario's operator knows a file's position and power by what the firmware may do.
void put(Conditions& c, const ChannelSettings& channel, const config::ChannelWiring& wiring) {
  PositionSensorSettings& sensor = c.position_sensor;
  sensor.noise_rms_m = channel.supervision.position_noise_rms_m;
  sensor.min_m = channel.supervision.min_position_m;
  sensor.range_m = channel.supervision.max_position_m;
  sensor.count_m = std::abs(channel.position.scaling.per_count);
  sensor.rate_Hz = 0.0;
  c.power.pwm_steps = wiring.pwm.steps;
  c.power.delay_s = channel.heater.delay_s;
  c.power.max_W = channel.limiter.max_W;
  c.power.min_W = channel.limiter.min_W;
  c.controller = channel.controllers.front();
  c.muscle = channel.muscle;
}

OrRefused check_joint(const Scenario& scenario) {
  if (!scenario.start.joint) return {};
  return tl::unexpected<std::string>("the scenario has a [joint]: its board is its own");
}

}  // namespace

OrRefused use_board(Scenario& scenario, const config::BoardConfig& config, std::size_t channel,
                    const std::optional<board::Learned>& learned) {
  if (auto checked = check_supply(scenario.start, config.settings); !checked) return checked;
  if (auto checked = check_events(scenario); !checked) return checked;
  if (auto checked = check_joint(scenario); !checked) return checked;
  BoardSettings board = config.settings;
  board.channels = {config.settings.channels[channel]};
  if (learned) apply_learned(board.channels[0], *learned);
  scenario.rate_Hz = board.rate_Hz;
  if (config.can) scenario.can = *config.can;
  scenario.can.first_node = static_cast<can::Node>(scenario.can.first_node + channel);
  put(scenario.start, board.channels[0], config.wiring.channels[channel]);
  for (Event& event : scenario.events)
    put(event.conditions, board.channels[0], config.wiring.channels[channel]);
  scenario.board = std::move(board);
  return {};
}

}  // namespace supercoil::host_sim
