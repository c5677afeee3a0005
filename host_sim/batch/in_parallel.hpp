// Tasks on as many threads as wanted.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace supercoil::host_sim::batch {

/// As many as requested; for 0, one per processor.
unsigned threads_for(int requested);

/// What to do with a task's result, on the calling thread; empty when it was given up.
using Handover = std::function<void()>;
/// Does the task of that number, on any thread; looks at stop now and then, and gives up.
using Task = std::function<Handover(std::size_t number, const std::atomic<bool>& stop)>;

/// Does the tasks 0 to count − 1 on `jobs` (>= 1) threads. Handovers are called one at a time, in
/// the order in which tasks end. `stop` is asked several times a second; true gives up what still
/// runs. Throws what a task or a handover threw.
void in_parallel(std::size_t count, unsigned jobs, const Task& task,
                 const std::function<bool()>& stop);

}  // namespace supercoil::host_sim::batch
