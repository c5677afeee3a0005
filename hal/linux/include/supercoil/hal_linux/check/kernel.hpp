// Whether kernel and processor wake a thread in time.
#pragma once

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/check/loop_thread_settings.hpp"
#include "supercoil/hal_linux/machine.hpp"

namespace supercoil::hal_linux {

/// Release, and whether it is a real-time kernel.
void check_kernel(const Machine& machine, const hal::FindingSink& sink);

/// How much of its time the kernel leaves to real-time threads (sched_rt_runtime_us).
void check_throttling(const Machine& machine, const hal::FindingSink& sink);

/// Whether processors change their frequency under way.
void check_governor(const Machine& machine, const hal::FindingSink& sink);

/// Which processors are kept free of other work, and whether the loop's own is there.
void check_processors(const Machine& machine, const LoopThreadSettings& settings,
                      const hal::FindingSink& sink);

}  // namespace supercoil::hal_linux
