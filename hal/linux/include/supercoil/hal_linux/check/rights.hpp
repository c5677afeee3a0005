// Whether this user may have what makes a thread wake in time, and what refuses it.
#pragma once

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/check/loop_thread_settings.hpp"
#include "supercoil/hal_linux/machine.hpp"

namespace supercoil::hal_linux {

/// Tries the priority on a thread of its own.
void check_priority(const Machine& machine, const LoopThreadSettings& settings,
                    const hal::FindingSink& sink);

/// Compares the limit of locked memory with what supercoild may need.
void check_locked_memory(const Machine& machine, const hal::FindingSink& sink);

/// Tries to keep the processors from deep sleep, for a moment.
void check_cpu_latency(const Machine& machine, const hal::FindingSink& sink);

}  // namespace supercoil::hal_linux
