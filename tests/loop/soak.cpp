// The whole firmware over a simulated board for a given number of ticks: it learns, its controllers
// take over from each other, and faults come and go. Nothing may drift: time, counters, memory,
// heat.
//   loop_soak [TICKS [MUSCLE]]    10^9 by hand (docs/architecture.md); the suite asks for fewer
// The muscle is real or real_hard (docs/muscles.md); without one it is linear.
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "loop/support/rig.hpp"
#include "plant/presets.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr long suite_ticks = 600'000;
constexpr int warm_up_cycles = 8;

struct InjectedFault {
  Fault fault;
  void (*inject)(Rig&);
  void (*remove)(Rig&);
};

constexpr std::array<InjectedFault, 6> injected_faults{{
    {Fault::emergency_stop, [](Rig& r) { r.board.stop_circuit.level.high = false; },
     [](Rig& r) { r.board.stop_circuit.level.high = true; }},
    {Fault::sensor_stale, [](Rig& r) { r.muscle().position.set({.silent = true}); },
     [](Rig& r) { r.muscle().position.set({.silent = false}); }},
    {Fault::command_timeout, [](Rig& r) { r.commands_flow = false; },
     [](Rig& r) { r.commands_flow = true; }},
    {Fault::heater_open, [](Rig& r) { r.muscle().faults.wire_open = true; },
     [](Rig& r) { r.muscle().faults.wire_open = false; }},
    {Fault::sensor_out_of_range, [](Rig& r) { r.muscle().position.set({.loose = true}); },
     [](Rig& r) { r.muscle().position.set({.loose = false}); }},
    {Fault::overrun, [](Rig& r) { r.board.lose_in_tick(10.5 * r.period_s()); }, [](Rig&) {}},
}};

double resident_MB() {
  long size = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return static_cast<double>(resident) * 4096e-6;
}

/// What must be the same after a thousand cycles as after eight.
struct Figures {
  double error_m = 0.0;  ///< rms over the last 5 s of following a reference
  double resident_MB = 0.0;
};

RigSettings rough_board_with(host_sim::MusclePreset preset) {
  RigSettings s = rough_board();
  const host_sim::PresetMuscle muscle = host_sim::preset_muscle(preset);
  for (std::size_t i = 0; i < s.board.channels.size(); ++i) {
    host_sim::MuscleChannelSettings& channel = s.board.channels[i];
    channel.plant = muscle.parameters;
    channel.effects = muscle.effects;
    ChannelSettings& firmware = s.firmware.channels[i];
    channel.effects.air_C = channel.rise_from_C = firmware.thermal.air.warmest_C;
    // After its first heating the muscle hangs lower at rest.
    channel.position.low = -0.005;
    firmware.position.scaling = {channel.position.per_count(), channel.position.low};
    firmware.supervision.min_position_m = channel.position.low;
  }
  return s;
}

class Soak {
 public:
  explicit Soak(const RigSettings& settings) : rig_(settings) {}
  bool run(long ticks);

 private:
  bool cycle();
  void follow();
  bool fail_and_recover(const InjectedFault& injected);
  bool require(bool holds, const char* what) {
    if (!holds) {
      std::printf("cycle %ld, tick %ld: %s; state %d, fault %d\n", cycles_, ticks(), what,
                  static_cast<int>(rig_.state()), static_cast<int>(rig_.fault()));
    }
    return holds;
  }
  long ticks() const { return std::lround(rig_.time_s() / rig_.period_s()); }
  bool nothing_drifted();
  void print(const char* when) const {
    std::printf(
        "%-6s %12ld ticks, %7ld cycles: follows within %.2f um rms, %.2f MB, %ld overruns\n", when,
        ticks(), cycles_, 1e6 * now_.error_m, now_.resident_MB, rig_.loop.overruns());
    std::fflush(stdout);
  }

  Rig rig_;
  long cycles_ = 0;
  long overruns_ = 0;  ///< those injected
  Figures first_;
  Figures now_;
};

/// All controllers, each taking over from the one before, and open loop.
void Soak::follow() {
  rig_.send(Verb::controller, static_cast<double>(cycles_ % 3));
  rig_.heat(Task::position);
  rig_.run(10.0);
  rig_.send(Verb::controller, static_cast<double>((cycles_ + 1) % 3));
  rig_.run(5.0);
  rig_.heat(Task::power);
  rig_.run(2.0);
  rig_.send(Verb::controller, 0.0);
  rig_.heat(Task::position);
  rig_.run(10.0);
  double sum_m2 = 0.0;
  constexpr int measured_ticks = 5000;
  for (int i = 0; i < measured_ticks; ++i) {
    rig_.tick();
    const double error_m = rig_.snapshot().position_m - rig_.snapshot().model_m;
    sum_m2 += error_m * error_m;
  }
  now_.error_m = std::sqrt(sum_m2 / measured_ticks);
}

bool Soak::fail_and_recover(const InjectedFault& injected) {
  injected.inject(rig_);
  rig_.run(0.5);
  if (!require(rig_.fault() == injected.fault, "another fault than was injected")) return false;
  if (!require(rig_.muscle().true_power_W() == 0.0, "a fault, and it heats")) return false;
  injected.remove(rig_);
  rig_.task = Task::nothing;
  rig_.run(1.0);
  rig_.send(Verb::reset);
  rig_.run(0.5);
  return require(rig_.state() == State::disarmed && rig_.loop.board_fault() == Fault::none,
                 "it cannot be reset");
}

bool Soak::nothing_drifted() {
  const hal::Duration apart = rig_.board.true_time() - rig_.snapshot().time;
  const bool together =
      apart >= hal::Duration{} && apart < hal::duration_from(2.0 * rig_.period_s());
  return require(together, "the loop's time is not the board's") &&
         require(rig_.loop.overruns() == overruns_, "overruns were counted wrongly") &&
         require(rig_.loop.timing().lost_rows.load() == 0, "rows were lost") &&
         require(!rig_.interval_missed, "the muscle's temperature left its interval") &&
         require(rig_.last_refusal == Refusal::none, "a command was refused");
}

bool Soak::cycle() {
  rig_.arm();
  rig_.run(0.2);
  if (!require(rig_.state() == State::armed, "it cannot be armed")) return false;
  follow();
  if (!require(rig_.state() == State::active, "it does not heat any more")) return false;
  const InjectedFault& injected =
      injected_faults[static_cast<std::size_t>(cycles_) % injected_faults.size()];
  if (injected.fault == Fault::overrun) overruns_ += 10;
  if (!fail_and_recover(injected)) return false;
  rig_.run(5.0);
  ++cycles_;
  now_.resident_MB = resident_MB();
  return nothing_drifted();
}

bool Soak::run(long ticks_asked) {
  rig_.boot();
  long next_print = suite_ticks;
  while (ticks() < ticks_asked) {
    if (!cycle()) return false;
    if (cycles_ == warm_up_cycles) {
      first_ = now_;
      print("first");
    }
    if (ticks() >= next_print) {
      print("");
      next_print *= 2;
    }
  }
  print("last");
  return require(now_.resident_MB <= first_.resident_MB + 1.0, "it needs more and more memory") &&
         require(now_.error_m <= 1.5 * first_.error_m, "it follows worse and worse");
}

}  // namespace

int main(int count, char** arguments) {
  RigSettings settings = rough_board();
  if (count > 2) {
    const auto preset = control::find_named(host_sim::preset_names, arguments[2]);
    if (preset != host_sim::MusclePreset::real && preset != host_sim::MusclePreset::real_hard) {
      std::fputs("loop_soak: the muscle must be real or real_hard\n", stderr);
      return 2;
    }
    settings = rough_board_with(*preset);
  }
  return Soak(settings).run(count > 1 ? std::atol(arguments[1]) : suite_ticks) ? 0 : 1;
}
