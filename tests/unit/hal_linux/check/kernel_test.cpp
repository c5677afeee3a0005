#include <sys/utsname.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/checks.hpp"

#include "unit/hal_linux/check/findings.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

TEST_GROUP(CheckKernel) {
  TemporaryFolder root;
  const Machine machine{root / "proc", root / "sys", root / "dev"};
  const std::string cpus = "sys/devices/system/cpu/";

  void setup() override {
    root.write("proc/sys/kernel/osrelease", "6.1.0-56-rt-arm64\n");
    root.write("sys/kernel/realtime", "1\n");
    root.write("proc/sys/kernel/sched_rt_runtime_us", "950000\n");
    root.write("proc/sys/kernel/sched_rt_period_us", "1000000\n");
    root.write(cpus + "online", "0-3\n");
    root.write(cpus + "isolated", "\n");
    root.make_folder(cpus + "cpufreq");
    for (const char* cpu : {"cpu0", "cpu1", "cpu2", "cpu3"})
      root.make_folder(cpus + cpu);
  }
  template <class Check>
  static hal::Finding only(const Check& check) {
    CollectedFindings collected;
    check(collected.sink());
    LONGS_EQUAL(1, collected.findings.size());
    return collected.findings.front();
  }
  hal::Finding kernel() const {
    return only([&](const hal::FindingSink& sink) { check_kernel(machine, sink); });
  }
  hal::Finding throttling() const {
    return only([&](const hal::FindingSink& sink) { check_throttling(machine, sink); });
  }
  hal::Finding governor() const {
    return only([&](const hal::FindingSink& sink) { check_governor(machine, sink); });
  }
  hal::Finding processors(int cpu) const {
    return only([&](const hal::FindingSink& sink) { check_processors(machine, {80, cpu}, sink); });
  }
};

TEST(CheckKernel, RecognisesARealTimeKernel) {
  check_finding("ok", "6.1.0-56-rt-arm64, real-time (PREEMPT_RT)", "", kernel());
  root.write("sys/kernel/realtime", "0\n");
  check_finding("warning", "not a real-time kernel", "PREEMPT_RT", kernel());
  root.remove("sys/kernel/realtime");
  check_finding("warning", "6.1.0-56-rt-arm64, not a real-time kernel", "PREEMPT_RT", kernel());
}

TEST(CheckKernel, ReportsTheFractionForRealTimeThreads) {
  check_finding("ok", "may use 95 % of each 1000000 us", "", throttling());
  root.write("proc/sys/kernel/sched_rt_runtime_us", "-1\n");
  check_finding("ok", "may use all of the processor", "", throttling());
  root.write("proc/sys/kernel/sched_rt_runtime_us", "900000\n");
  check_finding("ok", "may use 90 %", "", throttling());
  root.write("proc/sys/kernel/sched_rt_runtime_us", "899999\n");
  check_finding("warning", "may use 89 %", "sched_rt_runtime_us=950000", throttling());
  root.write("proc/sys/kernel/sched_rt_runtime_us", "500000\n");
  check_finding("warning", "may use 50 %", "sched_rt_runtime_us=950000", throttling());
  root.write("proc/sys/kernel/sched_rt_runtime_us", "0\n");
  check_finding("problem", "may use 0 %", "sched_rt_runtime_us=950000", throttling());
  root.remove("proc/sys/kernel/sched_rt_runtime_us");
  check_finding("warning", "not known: cannot open ", "a kernel that reports it", throttling());
}

TEST(CheckKernel, HasNoFractionWithoutAPositivePeriod) {
  for (const char* period : {"0\n", "-1\n"}) {
    root.write("proc/sys/kernel/sched_rt_period_us", period);
    check_finding("warning", "sched_rt_runtime_us has no period", "a kernel that reports it",
                  throttling());
  }
}

TEST(CheckKernel, NamesProcessorsThatMaySlowDown) {
  check_finding("ok", "no cpufreq", "", governor());
  for (const char* cpu : {"cpu0", "cpu1", "cpu2"})
    root.write(cpus + cpu + "/cpufreq/scaling_governor", "performance\n");
  check_finding("ok", "'performance' on all", "", governor());
  root.write(cpus + "cpu1/cpufreq/scaling_governor", "ondemand\n");
  root.write(cpus + "cpu2/cpufreq/scaling_governor", "ondemand\n");
  check_finding("warning", "governor 'ondemand' on cpu1, cpu2", "echo performance", governor());
}

TEST(CheckKernel, RecommendsIsolatingTheLoopsProcessor) {
  check_finding("ok", "running 0-3, isolated none", "", processors(-1));
  check_finding("warning", "other work may run on the loop's CPU, 3", "isolcpus=3", processors(3));
  check_finding("warning", "other work may run on the loop's CPU, 0", "isolcpus=0", processors(0));
  root.write(cpus + "isolated", "1,3\n");
  check_finding("ok", "isolated 1,3", "", processors(3));
  check_finding("ok", "isolated 1,3", "", processors(1));
  check_finding("warning", "isolated 1,3", "isolcpus=2", processors(2));
  check_finding("problem", ": CPU 4 is not running", "another --cpu", processors(4));
  root.write(cpus + "isolated", "0,2-3\n");
  check_finding("ok", "isolated 0,2-3", "", processors(2));
  check_finding("warning", "isolated 0,2-3", "isolcpus=1", processors(1));
}

TEST(CheckKernel, NamesDebiansRealTimeKernelForThisProcessor) {
  utsname machine_here{};
  LONGS_EQUAL(0, ::uname(&machine_here));
  const std::string architecture(&machine_here.machine[0]);
  std::string package = "linux-image-rt-… (apt-cache search linux-image-rt)";
  for (const auto& [of, name] : {std::pair("x86_64", "linux-image-rt-amd64"),
                                 {"aarch64", "linux-image-rt-arm64"},
                                 {"armv7l", "linux-image-rt-armmp"},
                                 {"i686", "linux-image-rt-686-pae"}}) {
    if (architecture == of) package = name;
  }
  root.write("sys/kernel/realtime", "0\n");
  check_finding("warning", "not a real-time kernel", "on Debian " + package + ":", kernel());
}

TEST(CheckKernel, AllowsTheLoopAnyProcessorByDefault) {
  check_finding("ok", "running 0-3", "",
                only([&](const hal::FindingSink& sink) { check_processors(machine, {}, sink); }));
}
