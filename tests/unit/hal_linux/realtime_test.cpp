#include "supercoil/hal_linux/realtime.hpp"

#include <cerrno>
#include <string>

#include <sys/resource.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/thread.hpp"

#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

void check_failed(const SetupStep& step, const std::string& reason) {
  CHECK_FALSE(step.succeeded);
  STRCMP_CONTAINS(reason.c_str(), step.reason.c_str());
  CHECK_FALSE(step.remedy.empty());
}

void check_worked(const SetupStep& step) {
  CHECK_TEXT(step.succeeded, step.reason.c_str());
  CHECK(step.reason.empty());
  CHECK(step.remedy.empty());
}

}  // namespace

TEST_GROUP(Realtime) {
  TemporaryFolder dev;
  void teardown() override {
    reset_calls();
  }
};

TEST(Realtime, LocksMemoryOrSaysWhyNot) {
  next(Call::mlockall, "", [] { return 0; });
  check_worked(lock_memory());
  fail_next(Call::mlockall, "", ENOMEM);
  check_failed(lock_memory(), "Cannot allocate memory; the limit of locked memory is ");
  fail_next(Call::mlockall, "", EPERM);
  STRCMP_EQUAL("run as root, or LimitMEMLOCK=infinity in the service",
               lock_memory().remedy.c_str());
}

TEST(Realtime, ReportsWhyThereIsNoPriority) {
  fail_next(Call::set_scheduling, "", EPERM);
  const SetupStep step = set_fifo_priority(::pthread_self(), 80);
  STRCMP_EQUAL("priority 80 of SCHED_FIFO", step.step.c_str());
  check_failed(step, "Operation not permitted; the limit of priority is ");
  fail_next(Call::set_scheduling, "", EINVAL);
  STRCMP_EQUAL("choose a priority of 1 to 99",
               set_fifo_priority(::pthread_self(), 100).remedy.c_str());
}

TEST(Realtime, VerifiesThatThePriorityWasSet) {
  next(Call::set_scheduling, "", [] { return 0; });
  check_failed(set_fifo_priority(::pthread_self(), 80),
               "accepted, but the thread does not have it");
  // Nor may it leave a different priority than requested, if this program may have one.
  const sched_param none{};
  sched_param higher{};
  higher.sched_priority = 2;
  if (::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &higher) == 0) {
    next(Call::set_scheduling, "", [] { return 0; });
    check_failed(set_fifo_priority(::pthread_self(), 1),
                 "accepted, but the thread does not have it");
    ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &none);
  }
  next(Call::set_affinity, "", [] { return 0; });
  check_failed(pin_to_cpu(::pthread_self(), 700), "accepted, but the thread may run elsewhere");
}

TEST(Realtime, PinsOnlyToAnExistingCpu) {
  SetupStep first;
  SetupStep none;
  {
    const auto thread = Thread::start({"pinned"}, [&] {
      first = pin_to_cpu(::pthread_self(), 0);
      none = pin_to_cpu(::pthread_self(), 900);
    });
  }
  check_worked(first);
  check_failed(none, "Invalid argument");
  check_failed(pin_to_cpu(::pthread_self(), -1), "Invalid argument");
  check_failed(pin_to_cpu(::pthread_self(), 1 << 20), "Invalid argument");
}

TEST(Realtime, KeepsTheCpusAwakeWithABinaryZero) {
  dev.write("cpu_dma_latency", "");
  CpuLatencyRequest cpus;
  check_worked(cpus.hold(dev / "cpu_dma_latency"));
  CHECK(dev.read("cpu_dma_latency") == std::string(4, '\0'));
}

TEST(Realtime, ReportsWhyTheCpusMaySleep) {
  CpuLatencyRequest cpus;
  check_failed(cpus.hold(dev / "cpu_dma_latency"), "cpu_dma_latency: No such file or directory");
  dev.write("cpu_dma_latency", "");
  next(Call::write, "/cpu_dma_latency", [] { return 2; });
  check_failed(cpus.hold(dev / "cpu_dma_latency"), "cpu_dma_latency: input/output error");
}

TEST(Realtime, TooSmallAThreadStackIsAnError) {
  const auto thread = Thread::start({"small", 0, -1, 1}, [] {});
  STRCMP_EQUAL("cannot start the thread 'small' with 1 bytes of stack: Invalid argument",
               thread.error().text().c_str());
}

TEST(Realtime, ReportsTheProgramsLimit) {
  rlimit limit{};
  LONGS_EQUAL(0, ::getrlimit(RLIMIT_MEMLOCK, &limit));
  const std::string bytes =
      limit.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(limit.rlim_cur);
  fail_next(Call::mlockall, "", ENOMEM);
  check_failed(lock_memory(), "the limit of locked memory is " + bytes + " bytes");
}

TEST(Realtime, RequestsTheConfiguredPriority) {
  SetupStep step;
  int priority = 0;
  {
    const auto thread = Thread::start({"first"}, [&] {
      step = set_fifo_priority(::pthread_self(), 1);
      sched_param now{};
      int policy = 0;
      ::pthread_getschedparam(::pthread_self(), &policy, &now);
      priority = now.sched_priority;
    });
    CHECK(thread.has_value());
  }
  // Not every program may have it, but 1 is a valid priority.
  CHECK(step.reason.find("Invalid argument") == std::string::npos);
  if (step.succeeded) LONGS_EQUAL(1, priority);
}
