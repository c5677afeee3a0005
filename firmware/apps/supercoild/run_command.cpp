#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>

#include <unistd.h>

#include "supercoil/hal_linux/realtime.hpp"
#include "supercoil/hal_linux/socket_can.hpp"

#include "apps/common/exit_status.hpp"
#include "apps/supercoild/bus_watch.hpp"
#include "apps/supercoild/commands.hpp"
#include "apps/supercoild/ending_signals.hpp"
#include "apps/supercoild/log.hpp"
#include "apps/supercoild/loop_thread.hpp"
#include "apps/supercoild/service.hpp"
#include "apps/supercoild/storage_worker.hpp"
#include "apps/supercoild/telemetry.hpp"
#include "linux_board/linux_board.hpp"
#include "linux_board/lock_file.hpp"
#include "text/program_version.hpp"

namespace supercoil::daemon {

namespace {

constexpr hal::Duration round_period = std::chrono::milliseconds(20);
/// The loop hangs if no row arrives in this many rounds: a second. Rounds are counted, not time,
/// because this thread may itself be delayed, and may wake before the threads that bring the rows.
constexpr int max_rounds_without_rows = 50;
/// Duties and enable lines are off a tick after the command; this is far longer.
constexpr hal::Duration cooling_timeout = std::chrono::seconds(2);
/// Bus threads must not hold up the loop.
constexpr int priority_offset = 10;

/// The daemon's parts, in the order of their creation; they are destroyed in reverse.
struct Parts {
  storage::PosixFiles files;
  std::vector<storage::LearnedStore> stores;
  std::optional<linux_board::LockFile> lock;
  std::unique_ptr<linux_board::LinuxBoard> board;
  hal_linux::CpuLatencyRequest wakeful;
  std::unique_ptr<Loop> loop;
  std::unique_ptr<StorageWorker> storage_worker;
  std::unique_ptr<hal_linux::SocketCan> can_bus;
  std::unique_ptr<telemetry::CanEndpoint> can;
  std::unique_ptr<Telemetry> telemetry;
  std::unique_ptr<LoopThread> thread;
};

/// text: a warning, or nothing.
void warn(const std::string& text) {
  if (!text.empty()) log(Level::warning, text);
}

/// A bus that is down is not an error: it may come up later.
Result<void> join_can(Parts& parts, const config::BoardConfig& config) {
  if (!config.can) return {};
  const auto ids = telemetry::received_ids(*config.can, config.settings.channels.size());
  auto bus = hal_linux::SocketCan::open({config.can->interface, ids});
  if (!bus) return failure("can: " + bus.error().text());
  parts.can_bus = std::move(*bus);
  parts.can = std::make_unique<telemetry::CanEndpoint>(*config.can, config.settings, *parts.loop,
                                                       *parts.can_bus,
                                                       [] { return std::random_device()(); });
  return {};
}

/// Starts buses, watchdog, commands, and finally the loop.
Result<void> start(Parts& parts, const config::BoardConfig& config, const RunOptions& options,
                   LocalCommands commands) {
  const double rate_Hz = config.settings.rate_Hz;
  const bool realtime = options.priority > 0;
  if (realtime) log_steps({hal_linux::lock_memory(), parts.wakeful.hold()});
  const int bus_priority = realtime ? std::max(1, options.priority - priority_offset) : 0;
  auto warning = parts.board->start(rate_Hz, bus_priority);
  if (!warning) return tl::unexpected(warning.error());
  warn(*warning);
  const board::Devices devices = parts.board->devices();
  parts.loop = std::make_unique<Loop>(config.settings, devices);
  if (auto joined = join_can(parts, config); !joined) return joined;
  parts.telemetry = std::make_unique<Telemetry>(*parts.loop, parts.storage_worker->relay(),
                                                std::move(commands), parts.can.get());
  if (auto started = parts.telemetry->start(); !started) return started;
  auto thread = LoopThread::start(*parts.loop, *devices.clock, rate_Hz,
                                  {"loop", options.priority, options.cpu});
  if (!thread) return tl::unexpected(thread.error());
  parts.thread = std::move(*thread);
  if (realtime) {
    log_steps(parts.board->steps());
    log_steps(parts.thread->steps());
  }
  return {};
}

/// Runs while rows keep coming, until the signal. Returns false when the loop hangs.
bool keep_until_signal(Parts& parts, Service& service) {
  hal_linux::MonotonicClock clock;
  std::uint64_t rows = 0;
  int rounds_without = 0;
  BusWatch buses;
  while (!ending_signal_within(round_period)) {
    const hal::Time now = clock.now();
    parts.storage_worker->poll(*parts.loop, now);
    for (const std::string& line : buses.new_warnings(parts.board->buses(), now))
      log(Level::warning, line);
    if (parts.storage_worker->rows() != rows) {
      rows = parts.storage_worker->rows();
      rounds_without = 0;
      service.alive(now);
    } else if (++rounds_without > max_rounds_without_rows) {
      return false;
    }
  }
  return true;
}

/// Turns every channel off and stops the loop. Returns false when that failed.
bool cool(Parts& parts) {
  parts.telemetry->cool();
  hal_linux::MonotonicClock clock;
  const hal::Time begin = clock.now();
  const timespec round_time{0, static_cast<decltype(timespec::tv_nsec)>(round_period.count())};
  do {
    nanosleep(&round_time, nullptr);
    parts.storage_worker->poll(*parts.loop, clock.now());
    if (clock.now() - begin > cooling_timeout) return false;
  } while (!parts.storage_worker->all_off());
  parts.thread->stop();
  parts.thread.reset();
  // The last rows come through the telemetry thread.
  nanosleep(&round_time, nullptr);
  parts.storage_worker->poll(*parts.loop, clock.now());
  parts.storage_worker->finish();
  return true;
}

}  // namespace

int run_command(const RunOptions& options) {
  auto config = config::read_board_config(options.config);
  if (!config) {
    std::fputs(config::to_text(config.error()).c_str(), stderr);
    return exit_wrong_input;
  }
  block_ending_signals();

  Parts parts;
  auto lock = linux_board::LockFile::take(options.run_folder + "/lock");
  if (!lock) return fail(lock.error().text());
  parts.lock.emplace(std::move(*lock));
  log(Level::info, "version " + std::string(program_version()));
  for (std::size_t i = 0; i < config->settings.channels.size(); ++i)
    parts.stores.emplace_back(config->storage_folder, static_cast<int>(i + 1), parts.files);
  if (const auto known = load_learned(*config, parts.stores); !known) {
    return fail(options.config + ": board.storage_folder: " + known.error().text());
  }
  auto board = linux_board::LinuxBoard::open(config->wiring);
  if (!board) {
    for (const std::string& problem : board.error())
      log(Level::problem, options.config + ": " + problem);
    return fail("nothing was started");
  }
  parts.board = std::move(*board);
  auto commands = LocalCommands::open(options.run_folder + "/commands");
  if (!commands) return fail(commands.error().text());
  parts.storage_worker = std::make_unique<StorageWorker>(*config, parts.stores, parts.files);

  if (const auto started = start(parts, *config, options, std::move(*commands)); !started) {
    // No loop runs that would feed the watchdog, and nothing was ever on.
    warn(parts.board->release());
    return fail(started.error().text());
  }
  log(Level::info, config->name + ": " + std::to_string(config->settings.channels.size()) +
                       " channels, disarmed");

  Service service;
  service.notify("READY=1\nSTATUS=disarmed at start");
  const bool alive = keep_until_signal(parts, service);
  service.notify("STOPPING=1");
  if (alive && cool(parts)) {
    warn(parts.board->release());
    log(Level::info, "everything is off; ended");
    return exit_done;
  }
  // The loop's thread cannot be joined. Its heartbeat has stopped, and the charge pump has opened
  // the supply; the kernel closes the rest, and the watchdog, no longer fed, fires.
  log(Level::problem, "the loop hangs: ended without it");
  std::_Exit(exit_failed);
}

}  // namespace supercoil::daemon
