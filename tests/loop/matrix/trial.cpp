#include "loop/matrix/trial.hpp"

#include "loop/matrix/aftermath.hpp"
#include "loop/matrix/neighbour.hpp"

namespace supercoil::test {

namespace {

/// Checks both ways of cutting the heat, at the tick of the fault.
std::string lines_wrong(Rig& rig, std::uint8_t channel) {
  const host_sim::MuscleChannel& muscle = rig.board.channel(channel);
  const std::string which = channel == Rig::tested ? "" : "of the neighbour ";
  if (muscle.enable.high()) return which + "the enable line is high";
  // A PWM that reads back wrongly is one step off; one that refuses is cut by its enable line.
  const bool obeys = muscle.pwm.refuses == hal::Status::ok;
  if (obeys && muscle.pwm.read_back() > 1) return which + "the duty is not 0";
  return "";
}

/// A fault of the whole board: the neighbour is cold too, and the supply is open once the pump has
/// decayed.
std::string board_wrong(Rig& rig, Fault fault, double decay_s) {
  if (rig.loop.board_fault() != fault)
    return "the board's fault is " + text(rig.loop.board_fault());
  if (std::string wrong = neighbour_wrong(rig, fault); !wrong.empty()) return wrong;
  if (std::string wrong = lines_wrong(rig, Rig::neighbour); !wrong.empty()) return wrong;
  // The heartbeat's last edge was a tick before; the board takes its steps after it looked.
  rig.run(decay_s + rig.period_s());
  return rig.board.supply_closed() ? "the supply is still closed" : "";
}

/// From now on, for a while: no power in the muscle, and the neighbour either goes on or is cold.
std::string heated(Rig& rig, Fault neighbours) {
  const double end_s = rig.time_s() + 0.2;
  while (rig.time_s() < end_s) {
    rig.tick();
    if (rig.muscle().true_power_W() > 0.0) return "the muscle is still heated";
    if (std::string wrong = neighbour_wrong(rig, neighbours); !wrong.empty()) return wrong;
    const bool neighbour_heated = rig.board.channel(Rig::neighbour).true_power_W() > 0.0;
    if (neighbours != Fault::none && neighbour_heated) return "the neighbour is still heated";
  }
  return "";
}

}  // namespace

RigSettings board_for(const FaultCase& c, double rate_Hz) {
  RigSettings settings = rough_board(rate_Hz);
  // Muscles known to be cold: otherwise every trial would first wait until they must have cooled.
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.thermal.boot_rise_K = 20.0;
  c.tune(settings);
  return settings;
}

std::string try_fault(const FaultCase& c, Situation situation, const RigSettings& settings,
                      double* seen_after_s) {
  Rig rig(settings);
  bring_to(situation, rig);
  const bool before = situation == Situation::fault;
  if (!before && rig.fault() != Fault::none) {
    return "before the injection there was " + text(rig.fault());
  }
  if (std::string wrong = neighbour_wrong(rig, before ? Fault::emergency_stop : Fault::none);
      !wrong.empty()) {
    return "before the injection " + wrong;
  }
  const double within_s = c.within.at(rig.period_s());
  const double injected_s = rig.time_s();
  c.inject(rig);
  if (before) {
    rig.run(within_s);
  } else {
    rig.run_until([&] { return rig.state() == State::fault; }, within_s);
  }
  *seen_after_s = rig.time_s() - injected_s;
  const Fault first = before ? Fault::emergency_stop : c.first ? c.first(situation) : c.fault;
  if (rig.state() != State::fault) return "not detected";
  if (rig.fault() != first) return "detected as " + text(rig.fault());
  if (std::string wrong = lines_wrong(rig, Rig::tested); !wrong.empty()) return wrong;

  // Where a fault of the channel comes first, the board's follows.
  const FaultInfo fault = *info(c.fault);
  const bool of_board = fault.scope == Scope::board;
  if (of_board && first != c.fault && !before) {
    rig.run_until([&] { return rig.loop.board_fault() != Fault::none; }, within_s - *seen_after_s);
    *seen_after_s = rig.time_s() - injected_s;
  }
  const Fault boards = before ? Fault::emergency_stop : c.fault;
  if (of_board || before) {
    const double decay_s = settings.firmware.supervision.charge_pump_decay_s;
    if (std::string wrong = board_wrong(rig, boards, decay_s); !wrong.empty()) return wrong;
  } else {
    rig.run_ticks(2);
  }
  // All channels share the bus, but nothing is wrong with the board: its heartbeat goes on.
  const bool everybody = of_board || before || fault.group == "bus";
  const Fault neighbours = everybody ? boards : Fault::none;
  if (std::string wrong = heated(rig, neighbours); !wrong.empty()) return wrong;
  if (rig.interval_missed) return "the temperature left its interval";
  return aftermath(c, rig, first, neighbours);
}

std::string try_self_test(const RigSettings& settings, double* seen_after_s) {
  for (const bool pump : {true, false}) {
    Rig rig(settings);
    rig.board.pump.stuck_closed = pump;
    rig.muscle().faults.enable_stuck_on = !pump;
    rig.boot();
    rig.run(0.2);
    *seen_after_s = rig.time_s();
    const std::string what = pump ? "stuck supply switch: " : "stuck enable: ";
    if (rig.fault() != Fault::self_test_failed) return what + "it is " + text(rig.fault());
    if (std::string wrong = neighbour_wrong(rig, Fault::self_test_failed); !wrong.empty()) {
      return what + wrong;
    }
    rig.send(Verb::reset);
    rig.run_ticks(10);
    if (rig.state() != State::fault) return what + "it was reset";
    rig.arm();
    rig.start_neighbour();
    if (rig.muscle().enable.high()) return what + "it was armed";
    if (rig.board.channel(Rig::neighbour).enable.high()) return what + "the neighbour was armed";
  }
  return "";
}

}  // namespace supercoil::test
