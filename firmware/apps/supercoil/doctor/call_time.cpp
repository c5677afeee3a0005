#include "apps/supercoil/doctor/call_time.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <sys/resource.h>

#include "supercoil/hal_linux/monotonic_clock.hpp"
#include "supercoil/hal_linux/thread.hpp"

namespace supercoil::doctor {

namespace {

/// The first calls meet cold memory and caches.
constexpr int warm_up_calls = 20;
constexpr int timed_calls = 200;
constexpr int max_interrupted = 200;

/// Involuntary context switches of the calling thread.
std::int64_t times_preempted() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw;
}

CallTime measure(const std::function<void()>& call) {
  using hal_linux::MonotonicClock;
  for (int i = 0; i < warm_up_calls; ++i)
    call();
  CallTime time;
  hal::Duration sum{};
  std::vector<hal::Duration> all;
  all.reserve(timed_calls);
  while (time.calls < timed_calls && time.interrupted < max_interrupted) {
    const std::int64_t preempted = times_preempted();
    const hal::Time before = MonotonicClock::time();
    call();
    const hal::Duration took = MonotonicClock::time() - before;
    if (times_preempted() != preempted) {
      ++time.interrupted;
      continue;
    }
    ++time.calls;
    sum += took;
    all.push_back(took);
  }
  if (all.empty()) return time;
  std::sort(all.begin(), all.end());
  time.mean = sum / time.calls;
  time.p99 = all[(all.size() * 99 - 1) / 100];
  time.worst = all.back();
  return time;
}

std::string in_us(hal::Duration duration) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f us", 1e6 * hal::seconds(duration));
  return text.data();
}

}  // namespace

CallTime time_calls(const std::function<void()>& call, int priority) {
  CallTime time;
  const auto body = [&] {
    const bool real_time = hal_linux::set_fifo_priority(::pthread_self(), priority).succeeded;
    time = measure(call);
    time.real_time = real_time;
  };
  // The thread is joined at the end of this statement.
  if (!hal_linux::Thread::start({"doctor"}, body).map([](hal_linux::Thread&&) {})) {
    time = measure(call);
  }
  return time;
}

std::string time_text(const CallTime& time) {
  std::string text = in_us(time.mean) + " on average, 99 % within " + in_us(time.p99) + ", " +
                     in_us(time.worst) + " at most, of " + std::to_string(time.calls) + " calls";
  if (time.interrupted > 0) text += ", " + std::to_string(time.interrupted) + " interrupted";
  return time.real_time ? text : text + " (without real-time priority)";
}

hal::Finding assess(const std::string& what, const std::string& found, const CallTime& time,
                    const std::string& remedy) {
  using hal::Severity;
  const std::string all = found + "; " + time_text(time);
  if (time.calls == 0) {
    return {what, Severity::warning, all + ": cannot be timed",
            "stop other programs that use this processor"};
  }
  if (time.p99 <= max_direct_call) return {what, Severity::ok, all, ""};
  const std::string slow = all + ": more than " + in_us(max_direct_call);
  if (time.real_time) return {what, Severity::problem, slow, remedy};
  return {what, Severity::warning, slow,
          "measure with the right to real-time priority; if it persists: " + remedy};
}

}  // namespace supercoil::doctor
