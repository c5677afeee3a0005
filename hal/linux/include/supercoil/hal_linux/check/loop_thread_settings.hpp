// How supercoild's loop is to run.
#pragma once

namespace supercoil::hal_linux {

/// Its options --priority and --cpu.
struct LoopThreadSettings {
  int priority = 80;  ///< of SCHED_FIFO, 1 to 99
  int cpu = -1;       ///< negative: any
};

}  // namespace supercoil::hal_linux
