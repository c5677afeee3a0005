// A thread with a stack of its own size.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pthread.h>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/realtime.hpp"

namespace supercoil::hal_linux {

/// How a thread should run.
struct ThreadSettings {
  std::string name;  ///< as top shows it: its first 15 characters
  int priority = 0;  ///< of SCHED_FIFO, 1 to 99; 0: an ordinary thread
  int cpu = -1;      ///< negative: any
  std::size_t stack_bytes = std::size_t{128} * 1024;  ///< all of it is locked in RAM
};

/// Runs `body` until it returns; the destructor waits for that. Move-only. std::thread cannot set
/// its stack size, and eight locked megabytes a thread are more than the firmware itself.
class Thread {
 public:
  static Result<Thread> start(const ThreadSettings& settings, std::function<void()> body);
  Thread(Thread&& other) noexcept = default;
  Thread& operator=(Thread&& other) = delete;
  ~Thread();

  /// The results of setting priority and CPU.
  const std::vector<SetupStep>& steps() const { return steps_; }

 private:
  struct Running {
    std::function<void()> body;
    pthread_t id{};
  };
  explicit Thread(std::unique_ptr<Running> running) : running_(std::move(running)) {}

  std::unique_ptr<Running> running_;
  std::vector<SetupStep> steps_;
};

}  // namespace supercoil::hal_linux
