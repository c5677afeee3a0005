// Runs tasks on several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace supercoil::host_sim::batch {

/// As many as requested; for 0, one per processor.
unsigned threads_for(int requested);

/// Takes a task's result, on the calling thread; empty when the task was given up.
using Handover = std::function<void()>;
/// Runs the task with this number on any thread; checks stop now and then, and gives up if set.
using Task = std::function<Handover(std::size_t number, const std::atomic<bool>& stop)>;

/// Runs the tasks 0 to count − 1 on `jobs` (>= 1) threads. Handovers are called one at a time, in
/// the order in which tasks end. `stop` is called several times a second; when it returns true,
/// running tasks are given up. Throws what a task or a handover threw.
void in_parallel(std::size_t count, unsigned jobs, const Task& task,
                 const std::function<bool()>& stop);

}  // namespace supercoil::host_sim::batch
