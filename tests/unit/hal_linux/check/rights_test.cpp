#include <cerrno>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/checks.hpp"

#include "unit/hal_linux/check/findings.hpp"
#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

TEST_GROUP(CheckRights) {
  TemporaryFolder root;
  const Machine machine{root / "proc", root / "sys", root / "dev"};
  CollectedFindings collected;

  void setup() override {
    set_capabilities("0000000000000000");
    limit("8388608");
  }
  void teardown() override {
    reset_calls();
  }
  void set_capabilities(const std::string& capabilities) const {
    root.write("proc/self/status", "Name:\tdoctor\nCapPrm:\tffffffffffffffff\nCapEff:\t" +
                                       capabilities + "\nCapBnd:\tffffffffffffffff\n");
  }
  void limit(const std::string& locked) const {
    root.write("proc/self/limits",
               "Limit                     Soft Limit           Hard Limit           Units\n"
               "Max processes             94000                94000                processes\n"
               "Max locked memory         " +
                   locked + "              8388608              bytes\n");
  }
  hal::Finding priority(int answer) {
    next(Call::set_scheduling, "", [answer] { return -answer; });
    check_priority(machine, {80, -1}, collected.sink());
    LONGS_EQUAL(0, waiting());
    return collected.findings.back();
  }
  hal::Finding memory() {
    check_locked_memory(machine, collected.sink());
    return collected.findings.back();
  }
};

TEST(CheckRights, NamesWhatPreventsThePriority) {
  check_finding("warning",
                "not priority 80 of SCHED_FIFO: Operation not permitted; the limit of priority is",
                "LimitRTPRIO=99", priority(EPERM));
  set_capabilities("0000000000800000");
  check_finding("warning", "despite CAP_SYS_NICE", "cpu.rt_runtime_us", priority(EPERM));
  STRCMP_CONTAINS("not priority 80 of SCHED_FIFO", collected.findings.back().found.c_str());
  // A sandbox that accepts the call but does nothing.
  set_capabilities("0000000000000000");
  check_finding("warning", "accepted, but the thread does not have it", "LimitRTPRIO=99",
                priority(0));
}

TEST(CheckRights, ComparesTheLimitOfLockedMemory) {
  check_finding("warning", "the limit is 8388608 bytes; 64 MiB are always enough",
                "LimitMEMLOCK=infinity", memory());
  limit("67108864");
  check_finding("ok", "limit 67108864", "", memory());
  limit("unlimited");
  check_finding("ok", "limit unlimited", "", memory());
  limit("nonsense");
  check_finding("warning", "no number in " + root / "proc/self/limits", "root", memory());
  set_capabilities("0000000000004000");
  check_finding("ok", "CAP_IPC_LOCK", "", memory());
}

TEST(CheckRights, SaysWhyProcessorsMaySleep) {
  check_cpu_latency(machine, collected.sink());
  check_finding("warning", "cannot open " + root / "dev/cpu_dma_latency", "allow writing to",
                collected.findings.back());
  root.write("dev/cpu_dma_latency", "");
  check_cpu_latency(machine, collected.sink());
  check_finding("ok", "CPUs kept from deep sleep", "", collected.findings.back());
}
