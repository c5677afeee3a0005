// Faults of commands, and of the controller.
#include "loop/matrix/cases/cases.hpp"

namespace supercoil::test {

namespace {

using enum Situation;

const std::vector<Situation> nothing_asked{disarmed, arming, armed, fault};
const std::vector<Situation> no_controller{disarmed, arming,    armed, power,
                                           identify, calibrate, fault};

void damage(Rig& rig) {
  rig.commands_flow = false;
  every_tick(rig, [&rig] { rig.loop.send_damaged(Rig::tested); });
}

/// `rest` where the channel is off, `arm` everywhere else: neither is allowed there.
void send_disallowed_command(Rig& rig) {
  rig.commands_flow = false;
  every_tick(rig, [&rig] {
    const bool off = rig.state() == State::disarmed || rig.state() == State::fault;
    rig.send(off ? Verb::rest : Verb::arm);
  });
}

void soon_lost(RigSettings& s) {
  ChannelSettings& channel = s.firmware.channels[Rig::tested];
  channel.limiter.max_W = 3.0;
  channel.supervision.saturated_s = 1.0;
  channel.supervision.max_travel_m = 0.055;
  channel.supervision.max_position_m = 0.06;
}

}  // namespace

std::vector<FaultCase> command_cases() {
  return {
      {.fault = Fault::command_timeout,
       .within = {0.25},
       .elsewhere = nothing_asked,
       .why_not = "nothing is asked for",
       .inject = [](Rig& r) { r.commands_flow = false; },
       .remove = [](Rig& r) { r.commands_flow = true; }},
      {.fault = Fault::command_damaged,
       .within = {0.0, 11},
       .inject = damage,
       .remove = nothing_more},
      {.fault = Fault::command_not_allowed,
       .within = {0.0, 11},
       .inject = send_disallowed_command,
       .remove = nothing_more},
      {.fault = Fault::controller_invalid,
       .within = {2.0},
       .elsewhere = no_controller,
       .why_not = "no controller is at work",
       .inject = [](Rig& r) { r.scale = 2.5; },
       .remove = [](Rig& r) { r.scale = 1.0; },
       .tune = soon_lost},
  };
}

}  // namespace supercoil::test
