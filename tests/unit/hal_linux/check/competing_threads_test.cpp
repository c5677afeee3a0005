#include <sched.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/checks.hpp"

#include "unit/hal_linux/check/findings.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

/// The format of proc(5).
std::string stat(const std::string& name, unsigned flags, int priority, int policy) {
  return "17 (" + name + ") S 1 17 17 0 -1 " + std::to_string(flags) +
         " 0 0 0 0 1 2 0 0 -51 0 1 0 100 0 0 18446744073709551615 0 0 0 0 0 0 0 2147483647 0 1 0 "
         "0 -1 0 " +
         std::to_string(priority) + " " + std::to_string(policy) + " 0 0 0 0 0 0 0 0 0 0 0\n";
}

constexpr unsigned of_kernel = 0x00208040;
constexpr unsigned of_user = 0x00400100;

}  // namespace

TEST_GROUP(CheckCompetingThreads) {
  TemporaryFolder root;
  const Machine machine{root / "proc", root / "sys", root / "dev"};

  void setup() override {
    root.write("proc/self/stat", "never read");
    root.write("proc/1/task/1/stat", stat("init", of_user, 0, SCHED_OTHER));
    root.write("proc/12/task/12/stat", stat("migration/0", of_kernel, 99, SCHED_FIFO));
  }
  hal::Finding found(int priority = 80) const {
    CollectedFindings collected;
    check_competing_threads(machine, {priority, -1}, collected.sink());
    LONGS_EQUAL(1, collected.findings.size());
    return collected.findings.front();
  }
};

TEST(CheckCompetingThreads, OnlyCountsKernelThreads) {
  check_finding("ok", "none above priority 80 (besides 1 kernel thread)", "", found());
}

TEST(CheckCompetingThreads, NamesProgramsWithAHigherPriority) {
  root.write("proc/300/task/300/stat", stat("pulse (audio)", of_user, 0, SCHED_OTHER));
  root.write("proc/300/task/301/stat", stat("pulse (audio)", of_user, 90, SCHED_FIFO));
  root.write("proc/300/task/302/stat", stat("pulse (audio)", of_user, 90, SCHED_FIFO));
  root.write("proc/400/task/400/stat", stat("camera", of_user, 0, 6));
  root.write("proc/500/task/500/stat", stat("as loud", of_user, 80, SCHED_RR));
  check_finding("warning",
                "camera (deadline), pulse (audio) (90), 2 threads above priority 80 (and 1 kernel "
                "thread)",
                "chrt", found());
  check_finding("warning", "camera (deadline) above priority 90", "chrt", found(90));
  check_finding("warning", "as loud (80)", "chrt", found(79));
}

TEST(CheckCompetingThreads, ToleratesThreadsThatEndMeanwhile) {
  root.make_folder("proc/600/task/600");
  root.write("proc/601/task/601/stat", "601 (cut");
  root.write("proc/602/task/602/stat", "602 (cut) R 1 2 3");
  check_finding("ok", "none above", "", found());
  CHECK_FALSE(parse_thread_stat("").has_value());
  CHECK_FALSE(parse_thread_stat(") 1 (").has_value());
  // Complete except for one bracket.
  const std::string whole = stat("x", of_user, 90, SCHED_FIFO);
  CHECK(parse_thread_stat(whole).has_value());
  CHECK_FALSE(parse_thread_stat(whole.substr(whole.find('(') + 1)).has_value());
  CHECK_FALSE(parse_thread_stat("5 (x) S a b c d e f g").has_value());
}

TEST(CheckCompetingThreads, CountsAProgramListedTwiceInProcOnce) {
  root.write("proc/300/task/301/stat", stat("pulse", of_user, 90, SCHED_FIFO));
  root.link("proc/thread-self", "proc/300");
  check_finding("warning", "pulse (90) above priority 80", "chrt", found());
}

TEST(CheckCompetingThreads, AreComparedWithPriority80ByDefault) {
  root.write("proc/300/task/300/stat", stat("as loud", of_user, 80, SCHED_FIFO));
  root.write("proc/300/task/301/stat", stat("louder", of_user, 81, SCHED_FIFO));
  CollectedFindings collected;
  check_competing_threads(machine, {}, collected.sink());
  check_finding("warning", "louder (81) above priority 80", "chrt", collected.findings.front());
}
