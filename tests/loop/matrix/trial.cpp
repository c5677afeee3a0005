#include "loop/matrix/trial.hpp"

#include <sstream>

namespace supercoil::test {

namespace {

std::string text(Fault fault) {
  return std::string(name(fault));
}

/// What is wrong with a rig that should be off since the last tick.
std::string still_hot(Rig& rig) {
  if (rig.muscle().enable.high()) return "the enable line is high";
  if (rig.muscle().pwm.read_back() > 1) return "the duty is not 0";
  return "";
}

/// The power in the muscle, one tick later and from then on; a switch that conducts by itself is
/// cut with the supply, within the stuck switch's own detection time and the charge pump's decay.
std::string still_heated(Rig& rig, bool stuck) {
  rig.run(stuck ? 0.05 + 0.02 + 0.005 : 0.002);
  for (int i = 0; i < 200; ++i) {
    rig.tick();
    if (rig.muscle().true_power_W() > 0.0) return "the muscle is still heated";
  }
  return "";
}

/// First cause, reset by an edge only, and no restart.
std::string afterwards(const FaultCase& c, Rig& rig, Fault first) {
  // A second fault does not replace the first.
  rig.board.stop_circuit.level.high = false;
  rig.run(0.01);
  if (rig.fault() != first) return "the first cause became " + text(rig.fault());
  const bool closes = c.fault != Fault::emergency_stop;
  if (closes) rig.board.stop_circuit.level.high = true;
  // A reset while the cause is there does nothing. (Of some, nothing is seen once power is off.)
  rig.send(Verb::reset);
  rig.tick();
  const bool persists =
      rig.loop.channel(0).present_fault() != Fault::none || rig.loop.board_fault() != Fault::none;
  if (persists && rig.state() != State::fault) return "it was reset while its cause was there";
  rig.board.stop_circuit.level.high = rig.board.stop_circuit.level.high || closes;
  c.remove(rig);
  rig.commands_flow = true;
  // A reset that is held from before is no edge.
  for (int i = 0; i < 1500 && rig.state() == State::fault; ++i) {
    rig.send(Verb::reset);
    rig.tick();
    if (persists && rig.state() != State::fault) return "it was reset by a held command";
  }
  rig.run(1.0);
  if (rig.state() == State::fault) {
    rig.send(Verb::reset);
    rig.run(0.01);
    // One edge for the board, one for the channel: the board's own fault is a cause as well.
    rig.send(Verb::reset);
    rig.run(0.01);
  }
  if (rig.state() != State::disarmed) {
    return "it cannot be reset: " + text(rig.loop.channel(0).present_fault()) + ", board " +
           text(rig.loop.board_fault());
  }
  for (int i = 0; i < 500; ++i) {
    // Refused commands in a row would be a fault of their own.
    rig.send(i % 2 == 0 ? Verb::position : Verb::disarm, 0.01);
    rig.tick();
    if (rig.muscle().true_power_W() > 0.0 || rig.state() != State::disarmed) {
      return "it restarted by itself";
    }
  }
  return "";
}

}  // namespace

std::string try_fault(const FaultCase& c, Situation situation, double* seen_after_s) {
  RigSettings settings = rough_board();
  c.tune(settings);
  Rig rig(settings);
  bring_to(situation, rig);
  if (situation != Situation::fault && rig.fault() != Fault::none) {
    return "before the injection there was " + text(rig.fault());
  }
  const Fault first = situation == Situation::fault ? Fault::emergency_stop
                      : c.first                     ? c.first(situation)
                                                    : c.fault;
  const double injected_s = rig.time_s();
  c.inject(rig);
  if (situation == Situation::fault) {
    rig.run(c.within_s);
  } else {
    rig.run_until([&] { return rig.state() == State::fault; }, c.within_s);
  }
  *seen_after_s = rig.time_s() - injected_s;
  if (rig.state() != State::fault) return "not detected";
  if (rig.fault() != first) return "detected as " + text(rig.fault());
  if (std::string wrong = still_hot(rig); !wrong.empty()) return wrong;
  const bool stuck = rig.muscle().trouble.switch_stuck_on;
  if (std::string wrong = still_heated(rig, stuck); !wrong.empty()) return wrong;
  if (info(c.fault)->scope == Scope::board) {
    if (rig.loop.board_fault() == Fault::none) return "the board has no fault";
    if (rig.board.supply_closed()) return "the supply is still closed";
  }
  if (rig.interval_missed) return "the temperature left its interval";
  return afterwards(c, rig, first);
}

std::string try_self_test(double* seen_after_s) {
  for (const bool pump : {true, false}) {
    Rig rig(rough_board());
    rig.board.pump.stuck_closed = pump;
    rig.muscle().trouble.enable_stuck_on = !pump;
    rig.boot();
    rig.run(0.2);
    *seen_after_s = rig.time_s();
    const char* what = pump ? "stuck supply switch: " : "stuck enable: ";
    if (rig.fault() != Fault::self_test_failed) return what + ("it is " + text(rig.fault()));
    rig.send(Verb::reset);
    rig.run(0.01);
    if (rig.state() != State::fault) return what + std::string("it was reset");
    rig.arm();
    rig.run(0.1);
    if (rig.muscle().enable.high()) return what + std::string("it was armed");
  }
  return "";
}

}  // namespace supercoil::test
