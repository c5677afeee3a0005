// Checks of a board before its muscles are heated: kernel, rights, other programs, watchdog, CAN.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/machine.hpp"

namespace supercoil::hal_linux {

/// supercoild's options --priority and --cpu.
struct LoopThreadSettings {
  int priority = 80;  ///< of SCHED_FIFO, 1 to 99
  int cpu = -1;       ///< negative: any
};

/// Release, and whether it is a real-time kernel.
void check_kernel(const Machine& machine, const hal::FindingSink& sink);

/// How much CPU time the kernel leaves to real-time threads (sched_rt_runtime_us).
void check_throttling(const Machine& machine, const hal::FindingSink& sink);

/// Whether processors change their frequency while running.
void check_governor(const Machine& machine, const hal::FindingSink& sink);

/// Which processors are kept free of other work, and whether the loop's is one of them.
void check_processors(const Machine& machine, const LoopThreadSettings& settings,
                      const hal::FindingSink& sink);

/// Tries the priority on a thread of its own.
void check_priority(const Machine& machine, const LoopThreadSettings& settings,
                    const hal::FindingSink& sink);

/// Compares the limit of locked memory with what supercoild may need.
void check_locked_memory(const Machine& machine, const hal::FindingSink& sink);

/// Tries to keep the processors from deep sleep, for a moment.
void check_cpu_latency(const Machine& machine, const hal::FindingSink& sink);

/// One thread as in /proc/PID/task/TID/stat.
struct ThreadStat {
  std::string name;
  bool of_kernel = false;
  int policy = 0;    ///< SCHED_OTHER …
  int priority = 0;  ///< 1 to 99 in SCHED_FIFO and SCHED_RR, else 0
};

/// Empty when the line is not valid.
std::optional<ThreadStat> parse_thread_stat(std::string_view line);

/// Threads of other programs above the loop's priority, or with deadlines. Kernel threads are only
/// counted: they are short and indispensable.
void check_competing_threads(const Machine& machine, const LoopThreadSettings& settings,
                             const hal::FindingSink& sink);

/// path: its device, e.g. /dev/watchdog. in_use: supercoild runs, and so does the watchdog.
void check_watchdog(const Machine& machine, const std::string& path, bool in_use,
                    const hal::FindingSink& sink);

/// Link, bit rate, and length of the transmit queue. interface: e.g. can0.
void check_can_interface(const Machine& machine, const std::string& interface,
                         const hal::FindingSink& sink);

/// In bit/s, as the kernel reports it by rtnetlink; empty for an interface without one (vcan).
std::optional<std::uint32_t> can_bit_rate(const std::string& interface);
/// The same, from the kernel's answer.
std::optional<std::uint32_t> bit_rate_in(const std::vector<std::byte>& answer);

}  // namespace supercoil::hal_linux
