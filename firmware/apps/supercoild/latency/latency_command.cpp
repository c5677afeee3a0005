#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <optional>

#include "apps/common/exit_status.hpp"
#include "apps/supercoild/commands.hpp"
#include "apps/supercoild/ending_signals.hpp"
#include "apps/supercoild/latency/inert_board.hpp"
#include "apps/supercoild/latency/report.hpp"
#include "apps/supercoild/log.hpp"
#include "apps/supercoild/loop_thread.hpp"
#include "config/board_config.hpp"

namespace supercoil::daemon {

namespace {

constexpr hal::Duration print_every = std::chrono::seconds(2);
constexpr double settling_s = 0.1;

std::optional<BoardSettings> settings_of(const LatencyOptions& options) {
  BoardSettings settings;
  settings.rate_Hz = options.rate_Hz;
  if (options.config.empty()) return settings;
  auto config = config::read_board_config(options.config);
  if (config) return std::move(config->settings);
  std::fputs(config::to_text(config.error()).c_str(), stderr);
  return std::nullopt;
}

std::uint64_t wanted_ticks(const LatencyOptions& options, double rate_Hz) {
  if (options.ticks > 0) return options.ticks;
  return static_cast<std::uint64_t>(
      std::max<std::int64_t>(1, std::llround(options.seconds * rate_Hz)));
}

void notify(const LatencyMeter& meter, std::uint64_t ticks) {
  log(Level::info, std::to_string(meter.measured()) + " of " + std::to_string(ticks) +
                       " ticks, the latest " + std::to_string(meter.latest().count() / 1000) +
                       " us after its time");
}

/// Stands in for the daemon's other threads until everything is measured or a signal ends it.
void keep_until_done(Loop& loop, const LatencyMeter& meter, std::uint64_t ticks) {
  const hal_linux::MonotonicClock clock;
  hal::Time next = clock.now() + print_every;
  std::uint32_t beats = 0;
  while (!meter.done() && !ending_signal_within(std::chrono::milliseconds(20))) {
    loop.health().telemetry_heartbeats.store(++beats, std::memory_order_relaxed);
    for (Row row; loop.take(row);) {
    }
    if (clock.now() < next) continue;
    next += print_every;
    notify(meter, ticks);
  }
}

}  // namespace

int latency_command(const LatencyOptions& options) {
  const auto settings = settings_of(options);
  if (!settings) return exit_wrong_input;
  block_ending_signals();
  const double rate_Hz = settings->rate_Hz;
  const std::uint64_t ticks = wanted_ticks(options, rate_Hz);
  LatencyConditions conditions{rate_Hz, settings->channels.size(), options.priority, {}};

  InertBoard board;
  Loop loop(*settings, board.devices(settings->channels.size()));
  LatencyMeter meter(loop, static_cast<std::uint64_t>(settling_s * rate_Hz), ticks);
  {
    hal_linux::CpuLatencyRequest wakeful;
    if (options.priority > 0) conditions.steps = {hal_linux::lock_memory(), wakeful.hold()};
    auto thread = LoopThread::start(loop, meter, rate_Hz, {"loop", options.priority, options.cpu});
    if (!thread) return fail(thread.error().text());
    conditions.steps.insert(conditions.steps.end(), (*thread)->steps().begin(),
                            (*thread)->steps().end());
    log_steps(conditions.steps);
    keep_until_done(loop, meter, ticks);
    (*thread)->stop();
  }
  const Latency& latency = meter.result();
  if (latency.late.count() == 0) return fail("ended before a tick was measured");
  std::fputs((options.json ? latency_json(latency, conditions) : latency_text(latency, conditions))
                 .c_str(),
             stdout);
  if (options.plot.empty()) return exit_done;
  const auto drawn = draw(latency_figure(latency, conditions), options.plot);
  return drawn ? exit_done : fail(drawn.error().text());
}

}  // namespace supercoil::daemon
