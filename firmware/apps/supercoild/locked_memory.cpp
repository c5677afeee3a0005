#include "apps/supercoild/locked_memory.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include <malloc.h>
#include <unistd.h>

#include "supercoil/hal_linux/thread.hpp"

#include "config/describe.hpp"

namespace supercoil::daemon {

namespace {

/// Mapped memory of this process; 0 when the kernel does not report it.
double mapped_bytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

double mebibytes(double bytes) {
  constexpr double tenths_of_mebibyte = 1024.0 * 1024.0 / 10.0;
  return std::round(bytes / tenths_of_mebibyte) / 10.0;
}

}  // namespace

void limit_heap() {
  mallopt(M_ARENA_MAX, 1);        // one arena for all threads
  mallopt(M_TOP_PAD, 16 * 1024);  // instead of 128 KiB in advance
}

std::string describe_locked_memory(const config::BoardConfig& config) {
  // Loop, telemetry, and one for each bus; the main thread's stack is part of the program's memory.
  const std::size_t threads = 2 + config.wiring.buses.size();
  const auto stacks = static_cast<double>(threads * hal_linux::ThreadSettings().stack_bytes);
  const config::Memory memory = config::memory_of(config.settings);
  // The relay (storage_worker.cpp) is as large as the loop's ring.
  const auto data = static_cast<double>(memory.total() + memory.ring);
  const double program = mapped_bytes();
  std::ostringstream out;
  out << "  locked   " << mebibytes(program + stacks + data)
      << " MiB: this and its relay, the program with its "
      << "libraries " << mebibytes(program) << " MiB, " << threads << " stacks "
      << mebibytes(stacks) << " MiB\n";
  return out.str();
}

}  // namespace supercoil::daemon
