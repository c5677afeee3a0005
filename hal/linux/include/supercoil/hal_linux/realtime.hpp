// Set-up that makes a thread wake on time; each step reports its outcome.
#pragma once

#include <string>

#include <pthread.h>

#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::hal_linux {

/// One step of the set-up. A step that fails leaves the firmware working, only less punctual.
struct SetupStep {
  std::string step;  ///< what was tried, e.g. "priority 80 of SCHED_FIFO"
  bool succeeded = false;
  std::string reason;  ///< empty when it succeeded
  std::string remedy;  ///< empty when it succeeded
};

/// Keeps the process's present and future memory in RAM. Call it before threads are started: their
/// whole stacks are locked as well.
SetupStep lock_memory();

/// 1 to 99, above all ordinary threads; checked by reading it back.
SetupStep set_fifo_priority(pthread_t thread, int priority);

/// The thread runs on this CPU alone; checked by reading it back.
SetupStep pin_to_cpu(pthread_t thread, int cpu);

/// While it lives, CPUs do not enter sleep states that take long to wake from. Move-only.
class CpuLatencyRequest {
 public:
  SetupStep hold(const std::string& path = "/dev/cpu_dma_latency");

 private:
  Descriptor file_;
};

}  // namespace supercoil::hal_linux
