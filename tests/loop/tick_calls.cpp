// Counts allocations, locks, writes and exceptions in the ticks, with every detector on and through
// every mode, switch and fault: none are allowed.
#include <cstdio>
#include <string>

#include "loop/matrix/fault_case.hpp"
#include "support/watched_calls.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

struct Seen {
  long ticks = 0;
  WatchedCalls calls;
  bool whole_life = false;  ///< every command was obeyed to the end
};

void run(Rig& rig, double time_s, Seen& seen) {
  const long ticks = std::lround(time_s * 1000.0);
  seen.calls += counted([&] {
    for (long i = 0; i < ticks; ++i)
      rig.tick();
  });
  seen.ticks += ticks;
}

/// The load swings while the zero is taken.
void fail_to_calibrate(Rig& rig, Seen& seen) {
  host_sim::MuscleChannelSettings swinging = rough_board().board.channels[Rig::tested];
  rig.heat(Task::calibrate);
  for (int i = 0; i < 300; ++i) {
    swinging.load_N = -0.03 * (1.0 + std::sin(3.0 * rig.time_s()));
    rig.muscle().set(swinging);
    run(rig, 0.01, seen);
  }
  swinging.load_N = 0.0;
  rig.muscle().set(swinging);
  run(rig, 1.0, seen);
}

/// Commands that are not obeyed, each for another reason.
void send_refused_commands(Rig& rig, Seen& seen) {
  rig.send(Verb::none);
  rig.send(Verb::position, std::nan(""));
  rig.send(Verb::scale, 100.0);
  rig.send(Verb::identify);
  rig.send(Verb::arm);
  rig.loop.send({7, Verb::arm, 0.0});
  rig.loop.send_damaged(Rig::tested);
  run(rig, 0.01, seen);
}

/// Gives the following controller the tuning of each law in turn; false when one was refused. It is
/// the controller with a reference model that every law can follow.
bool tune(Rig& rig, Seen& seen) {
  constexpr std::size_t place = 2;
  rig.send(Verb::controller, place);
  bool taken = true;
  for (std::size_t kind = 1; kind < control::controller_names.size(); ++kind) {
    Tuner& tuner = rig.loop.channel(Rig::tested).tuner();
    tuner.prepare(place, 0, static_cast<double>(kind));
    rig.send(Verb::tune, place);
    run(rig, 2.0, seen);
    taken = taken && tuner.value(TuningSet::in_use, place, 0) == static_cast<double>(kind);
  }
  return taken;
}

/// A whole life: boot, calibrate, identify, every controller, hot switches, fault, reset.
void live(Seen& seen) {
  RigSettings settings = rough_board();
  for (ChannelSettings& channel : settings.firmware.channels)
    channel.thermal.boot_rise_K = 2.0;
  Rig rig(settings);
  run(rig, 1.0, seen);
  rig.loop.send({Rig::neighbour, Verb::arm, 0.0});
  rig.send(Verb::arm);
  run(rig, 0.2, seen);
  rig.loop.send({Rig::neighbour, Verb::position, 0.008});
  rig.heat(Task::calibrate);
  run(rig, 8.0, seen);
  fail_to_calibrate(rig, seen);
  rig.heat(Task::identify);
  run(rig, 61.0, seen);
  rig.heat(Task::identify);
  run(rig, 5.0, seen);
  rig.send(Verb::rest);
  run(rig, 0.1, seen);
  rig.heat(Task::position);
  for (int i = 0; i < 9; ++i) {
    rig.send(Verb::controller, i % 3);
    rig.send(Verb::estimator, 0);
    run(rig, 5.0, seen);
  }
  const bool tuned = tune(rig, seen);
  rig.heat(Task::power);
  run(rig, 5.0, seen);
  rig.send(Verb::scale, rig.snapshot().position_m);
  send_refused_commands(rig, seen);
  rig.board.stop_circuit.level.high = false;
  run(rig, 0.2, seen);
  rig.board.stop_circuit.level.high = true;
  run(rig, 0.01, seen);
  rig.send(Verb::reset);
  run(rig, 1.0, seen);
  rig.send(Verb::arm);
  run(rig, 0.2, seen);
  board::LearnedUpdate update;
  int results = 0;
  while (rig.loop.channel(Rig::tested).take_learned_update(update))
    ++results;
  // The results of calibrate, identify and scale.
  seen.whole_life = rig.state() == State::armed && results == 3 && tuned;
}

void break_everything(Seen& seen) {
  for (const FaultCase& c : fault_cases()) {
    RigSettings settings = rough_board();
    c.tune(settings);
    Rig rig(settings);
    bring_to(Situation::mrac, rig);
    c.inject(rig);
    run(rig, std::fmin(c.within.at(rig.period_s()), 3.0), seen);
    c.remove(rig);
    rig.send(Verb::reset);
    run(rig, 0.1, seen);
  }
}

}  // namespace

int main() {
  if (prove_the_counters() != 0) return 1;
  Seen seen;
  live(seen);
  break_everything(seen);
  const WatchedCalls& c = seen.calls;
  std::printf("%ld ticks: malloc %ld, new %ld, locks %ld, files %ld, exceptions %ld\n", seen.ticks,
              c.heap, c.news, c.locks, c.files, c.throws);
  if (!seen.whole_life) std::printf("FAILED: the life ended in another state\n");
  return c.all() == 0 && seen.whole_life ? 0 : 1;
}
