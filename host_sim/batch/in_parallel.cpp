#include "batch/in_parallel.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace supercoil::host_sim::batch {

namespace {

/// What the threads share.
class Work {
 public:
  Work(std::size_t count, const Task& task) : count_(count), task_(&task) {}

  /// What each thread does.
  void work() {
    try {
      for (std::size_t i = next_++; i < count_ && !stop; i = next_++) {
        if (Handover handover = (*task_)(i, stop)) hand_over(std::move(handover));
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      stop = true;
    }
    const std::lock_guard lock(mutex_);
    ++idle_;
    news_.notify_one();
  }

  /// The handovers since the last call. Waits a while for one, or until all `jobs` threads end.
  std::vector<Handover> wait(unsigned jobs) {
    using namespace std::chrono_literals;
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, 200ms, [&] { return !ended_.empty() || idle_ == jobs; });
    all_done_ = idle_ == jobs;
    return std::exchange(ended_, {});
  }
  bool all_done() const { return all_done_; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  std::atomic<bool> stop = false;

 private:
  void hand_over(Handover handover) {
    const std::lock_guard lock(mutex_);
    ended_.push_back(std::move(handover));
    news_.notify_one();
  }

  std::size_t count_;
  const Task* task_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::condition_variable news_;
  std::vector<Handover> ended_;
  unsigned idle_ = 0;
  bool all_done_ = false;
  std::exception_ptr failure_;
};

}  // namespace

unsigned threads_for(int requested) {
  if (requested > 0) return static_cast<unsigned>(requested);
  return std::max(1U, std::thread::hardware_concurrency());
}

void in_parallel(std::size_t count, unsigned jobs, const Task& task,
                 const std::function<bool()>& stop) {
  Work work(count, task);
  std::vector<std::jthread> threads;
  // Also when a handover throws: the threads end before `work` is destroyed.
  struct Stop {
    std::atomic<bool>* stop;
    ~Stop() { *stop = true; }
  };
  {
    const Stop at_the_end{&work.stop};
    for (unsigned i = 0; i < jobs; ++i)
      threads.emplace_back([&] { work.work(); });
    while (!work.all_done()) {
      for (const Handover& handover : work.wait(jobs))
        handover();
      if (stop()) work.stop = true;
    }
  }
  threads.clear();
  work.rethrow();
}

}  // namespace supercoil::host_sim::batch
