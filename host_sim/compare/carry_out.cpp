#include "compare/carry_out.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "runner/simulation.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::host_sim::compare {

namespace {

constexpr long look_every_ticks = 4096;

/// Empty when it was given up.
std::optional<Result> simulate(const Case& of, std::uint64_t seed, const std::atomic<bool>& stop) {
  Scenario scenario = of.scenario;
  scenario.seed = seed;
  Simulation simulation(scenario);
  Meters meters(scenario);
  Fault fault = Fault::none;
  while (!simulation.done()) {
    if (simulation.tick() % look_every_ticks == 0 && stop) return std::nullopt;
    const TickRecord record = simulation.step();
    meters.add(record);
    if (fault == Fault::none) fault = record.fault;
    if (fault == Fault::none) fault = record.board_fault;
  }
  return Result{of.definition, fault == Fault::none ? "" : std::string(name(fault)),
                meters.values()};
}

/// What the threads share.
class Work {
 public:
  Work(const std::vector<Case>& cases, const std::vector<Run>& runs)
      : cases_(&cases), runs_(&runs) {}

  /// What each thread does.
  void work() {
    try {
      for (std::size_t i = next_++; i < runs_->size() && !stop; i = next_++) {
        const Run& run = (*runs_)[i];
        const auto result = simulate((*cases_)[run.of], run.seed, stop);
        if (result) hand_over({run, *result});
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

  /// What has ended since it was last asked; waits a while for something. Empty at the end when all
  /// `jobs` threads are done.
  std::vector<std::pair<Run, Result>> wait(unsigned jobs) {
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
  void hand_over(std::pair<Run, Result> ended) {
    const std::lock_guard lock(mutex_);
    ended_.push_back(std::move(ended));
    news_.notify_one();
  }

  const std::vector<Case>* cases_;
  const std::vector<Run>* runs_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::condition_variable news_;
  std::vector<std::pair<Run, Result>> ended_;
  unsigned idle_ = 0;
  bool all_done_ = false;
  std::exception_ptr failure_;
};

}  // namespace

void carry_out(const std::vector<Case>& cases, const std::vector<Run>& runs, unsigned jobs,
               const Listener& listener) {
  Work work(cases, runs);
  std::vector<std::jthread> threads;
  // Also when ended() throws: threads are joined before the work is gone.
  struct Stop {
    std::atomic<bool>* stop;
    ~Stop() { *stop = true; }
  };
  {
    const Stop at_the_end{&work.stop};
    for (unsigned i = 0; i < jobs; ++i)
      threads.emplace_back([&] { work.work(); });
    while (!work.all_done()) {
      for (const auto& [run, result] : work.wait(jobs))
        listener.ended(run, result);
      if (listener.stop()) work.stop = true;
    }
  }
  threads.clear();
  work.rethrow();
}

}  // namespace supercoil::host_sim::compare
