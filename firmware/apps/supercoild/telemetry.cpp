#include "apps/supercoild/telemetry.hpp"

#include <chrono>

#include <poll.h>

#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "apps/supercoild/ending_signals.hpp"
#include "apps/supercoild/rounds.hpp"

namespace supercoil::daemon {

Result<void> Telemetry::start() {
  auto thread = hal_linux::Thread::start({"telemetry"}, [this] { run(); });
  if (!thread) return tl::unexpected(thread.error());
  thread_ = std::make_unique<hal_linux::Thread>(std::move(*thread));
  return {};
}

void Telemetry::run() {
  hal_linux::MonotonicClock clock;
  Rounds rounds(clock.now());
  while (!ending_.load(std::memory_order_relaxed)) {
    loop_->health().telemetry_heartbeats.store(++beats_, std::memory_order_relaxed);
    // The main thread may not have noticed the signal: it may be waiting for the disk.
    if (ending_signal_is_pending()) cool();
    const bool cooling = cooling_.load(std::memory_order_relaxed);
    if (cooling) disarm_all();
    // A command's answer takes at most a tick and this wait.
    const auto wait_ms = static_cast<int>(
        std::chrono::ceil<std::chrono::milliseconds>(rounds.wait(clock.now())).count());
    if (commands_ && !cooling) {
      commands_->serve(*loop_, rows_, wait_ms);
    } else {
      ::poll(nullptr, 0, wait_ms);
    }
    pass_rows();
    pass_answers();
    if (can_ != nullptr && !cooling) can_->poll(clock.now());
  }
}

void Telemetry::disarm_all() {
  for (std::size_t i = 0; i < loop_->channels(); ++i)
    loop_->send({static_cast<std::uint8_t>(i), Verb::disarm});
}

void Telemetry::pass_rows() {
  for (Row row; loop_->take(row);) {
    relay_->put(row);
    rows_.put(row);
    if (can_ != nullptr) can_->offer(row);
  }
}

void Telemetry::pass_answers() {
  for (Answer answer; loop_->answer(answer);) {
    if (answer.command.source == Source::can && can_ != nullptr) {
      can_->answer(answer);
    } else if (commands_) {
      commands_->pass(answer, *loop_);
    }
  }
}

}  // namespace supercoil::daemon
