// Runs supercoild's loop over the board's real devices, and counts what each of its ticks calls.
//   supercoil-rig-tick-calls CONFIG TICKS
// Arms channel 1 and lets it follow positions; the script does everything else to the board.
#include <array>
#include <cstdio>
#include <cstdlib>

#include "supercoil/hal_linux/realtime.hpp"

#include "config/board_config.hpp"
#include "linux_board/linux_board.hpp"
#include "loop/executive.hpp"
#include "support/watched_calls.hpp"

using namespace supercoil;

namespace {

constexpr int priority = 80;
constexpr int bus_priority = 70;

/// Of all ticks so far.
struct Seen {
  test::WatchedCalls calls;
  std::array<long, state_names.size()> in_state{};
  long ticks = 0;
};

/// As an operator does, between ticks: arms, and renews its command.
void command(Loop& loop, long tick) {
  constexpr long every = 10;
  constexpr double middle_m = 0.010;
  constexpr double swing_m = 0.003;
  if (tick % every != 0) return;
  const State state = loop.channel(0).state().state();
  if (state == State::disarmed) loop.send({0, Verb::arm});
  const bool out = tick / 500 % 2 == 0;
  if (state == State::armed || state == State::active)
    loop.send({0, Verb::position, out ? middle_m + swing_m : middle_m - swing_m});
}

/// What other threads of supercoild take from the loop.
void empty(Loop& loop) {
  Answer answer;
  while (loop.answer(answer)) {
  }
  Row row;
  while (loop.take(row)) {
  }
}

void run(Loop& loop, Executive& executive, long ticks, Seen& seen) {
  for (seen.ticks = 0; seen.ticks < ticks; ++seen.ticks) {
    loop.health().telemetry_heartbeats.store(static_cast<std::uint32_t>(seen.ticks));
    command(loop, seen.ticks);
    seen.calls += test::counted([&] { executive.run_tick(); });
    empty(loop);
    ++seen.in_state.at(static_cast<std::size_t>(loop.channel(0).state().state()));
  }
}

int fail(const std::string& why) {
  std::fprintf(stderr, "supercoil-rig-tick-calls: %s\n", why.c_str());
  return EXIT_FAILURE;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return fail("needs a configuration and a number of ticks");
  if (test::prove_the_counters() != 0) return fail("a counter is blind");
  const auto config = config::read_board_config(arguments[1]);
  if (!config) return fail(config::to_text(config.error()));
  auto board = linux_board::LinuxBoard::open(config->wiring);
  if (!board) return fail(board.error().front());
  const double rate_Hz = config->settings.rate_Hz;
  if (const auto started = (*board)->start(rate_Hz, bus_priority); !started) {
    return fail(started.error().text());
  }
  hal_linux::CpuLatencyRequest cpus;
  for (const auto& step : {hal_linux::lock_memory(),
                           hal_linux::set_fifo_priority(::pthread_self(), priority), cpus.hold()})
    if (!step.succeeded) std::printf("not %s: %s\n", step.step.c_str(), step.reason.c_str());

  const board::Devices devices = (*board)->devices();
  Loop loop(config->settings, devices);
  Executive executive(loop, *devices.clock, rate_Hz);
  Seen seen;
  run(loop, executive, std::strtol(arguments[2], nullptr, 10), seen);
  (*board)->release();

  for (std::size_t i = 0; i < state_names.size(); ++i)
    std::printf("counted %s %ld\n", std::string(state_names.at(i)).c_str(), seen.in_state.at(i));
  // A tick writes only once, to feed the watchdog, and never to a disk.
  const long feedings = config->wiring.watchdog ? seen.ticks : 0;
  std::printf(
      "counted ticks %ld\ncounted malloc %ld\ncounted new %ld\ncounted locks %ld\n"
      "counted files %ld\ncounted exceptions %ld\ncounted overruns %ld\n",
      seen.ticks, seen.calls.heap, seen.calls.news, seen.calls.locks, seen.calls.files - feedings,
      seen.calls.throws, loop.overruns());
  return EXIT_SUCCESS;
}
