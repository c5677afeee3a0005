#include "daemon/telemetry.hpp"

#include <csignal>

#include <poll.h>

namespace supercoil::daemon {

namespace {
/// A command waits for its answer at most a tick and this.
constexpr int round_ms = 5;

/// Asked to end, although the main thread has not noticed: it may be waiting for the disk.
bool ending_is_asked() {
  sigset_t pending;
  sigemptyset(&pending);
  sigpending(&pending);
  return sigismember(&pending, SIGTERM) == 1 || sigismember(&pending, SIGINT) == 1;
}
}  // namespace

tl::expected<void, std::string> Telemetry::start() {
  auto thread = hal_linux::Thread::start({"telemetry"}, [this] { run(); });
  if (!thread) return tl::unexpected(thread.error().text);
  thread_ = std::make_unique<hal_linux::Thread>(std::move(*thread));
  return {};
}

void Telemetry::run() {
  while (!ending_.load(std::memory_order_relaxed)) {
    loop_->health().telemetry_beats.store(++beats_, std::memory_order_relaxed);
    if (ending_is_asked()) cool();
    if (cooling_.load(std::memory_order_relaxed)) {
      for (std::size_t i = 0; i < loop_->channels(); ++i)
        loop_->send({static_cast<std::uint8_t>(i), Verb::disarm});
      Answer answer;
      while (loop_->answer(answer)) {
      }
      ::poll(nullptr, 0, round_ms);
    } else if (commands_) {
      commands_->serve(*loop_, *rows_, round_ms);
    } else {
      ::poll(nullptr, 0, round_ms);
    }
  }
}

}  // namespace supercoil::daemon
