#include "loop/matrix/joint_trial.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::test {

namespace {

/// Scales the commands of a single muscle: a joint of 8 mm either way needs less,
constexpr double joint_scale = 0.3;
constexpr double max_joint_scale = 0.56;  ///< and takes no more

/// Thresholds of a joint: each muscle moves it half as far, with half the power.
void tune_joint(const FaultCase& c, RigSettings& s) {
  for (ChannelSettings& channel : s.firmware.channels) {
    channel.thermal.boot_rise_K = 20.0;
    if (c.fault == Fault::energy_budget_exceeded) channel.supervision.energy_J = 10.0;
    if (c.fault == Fault::controller_invalid) channel.limiter.max_W = 1.0;
    // The other muscle's resistance tells that it is not where this one has brought it.
    const bool by_position =
        c.fault == Fault::heater_not_responding || c.fault == Fault::muscle_loose;
    if (by_position) channel.heater.temperature_coefficient_per_K = 0.0;
  }
}

void bring_to_joint(const FaultCase& c, Situation situation, Rig& rig) {
  // Before the fault, weak heaters must not be at their limits, nor the joint near its end stops.
  const bool near_zero = c.fault == Fault::controller_invalid || c.fault == Fault::muscle_loose;
  rig.scale = near_zero ? 0.1 : joint_scale;
  rig.boot();
  if (situation == Situation::disarmed) return;
  rig.arm();
  rig.run(0.2);
  if (situation == Situation::armed) return;
  rig.send(Verb::controller, 1);
  rig.heat(Task::position);
  rig.run(8.0);
}

bool is_cold(Rig& rig, std::uint8_t channel) {
  host_sim::MuscleChannel& muscle = rig.board.channel(channel);
  const bool obeys = muscle.pwm.refuses == hal::Status::ok;
  return !muscle.enable.high() && (!obeys || muscle.pwm.read_back() <= 1);
}

std::string wrong_of_both(Rig& rig, Fault expected) {
  for (const std::uint8_t i : {Rig::tested, Rig::neighbour}) {
    const ChannelState& state = rig.loop.channel(i).state();
    const std::string which = i == Rig::tested ? "the agonist" : "the antagonist";
    if (state.state() != State::fault) return which + " is " + std::string(name(state.state()));
    if (state.first_cause() != expected) return which + " has " + text(state.first_cause());
    if (!is_cold(rig, i)) return which + " is not cold";
  }
  return "";
}

}  // namespace

std::string try_joint(const FaultCase& c, Situation situation) {
  RigSettings settings = joint_board();
  c.tune(settings);
  tune_joint(c, settings);
  Rig rig(settings);
  bring_to_joint(c, situation, rig);
  if (rig.fault() != Fault::none) return "before the injection there was " + text(rig.fault());
  const double demanded_scale = rig.scale;
  c.inject(rig);
  // Holding still demands nothing from a muscle whose sensor has stopped, so the reference moves;
  // but not for more than the power there is, which would be muscle_loose.
  if (c.fault == Fault::heater_not_responding) {
    rig.before_tick = [&rig] {
      rig.scale = joint_scale * (1.0 + 0.4 * std::sin(0.5 * rig.time_s()));
    };
  }
  if (rig.scale != demanded_scale) rig.scale = std::min(rig.scale * joint_scale, max_joint_scale);
  rig.run_until([&] { return rig.state() == State::fault; }, c.within.at(rig.period_s()));
  if (std::string wrong = wrong_of_both(rig, c.first ? c.first(situation) : c.fault);
      !wrong.empty())
    return wrong;
  if (rig.interval_missed) return "a temperature left its interval";
  // Whether or not the cause is gone, nothing heats again by itself.
  c.remove(rig);
  const double end_s = rig.time_s() + 1.0;
  while (rig.time_s() < end_s) {
    rig.tick();
    if (rig.board.channel(Rig::neighbour).true_power_W() > 0.0 || rig.muscle().true_power_W() > 0.0)
      return "a muscle is heated again";
  }
  return "";
}

}  // namespace supercoil::test
