// Every fault × everything that a channel can be doing. Prints what was tried; its exit status
// is the verdict.
#include <cstdio>

#include "loop/matrix/trial.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

struct Count {
  int tried = 0;
  int failed = 0;
  int not_possible = 0;
};

bool contains(const std::vector<Situation>& list, Situation situation) {
  for (const Situation s : list) {
    if (s == situation) return true;
  }
  return false;
}

void report(Count& count, Fault fault, std::string_view where, const std::string& wrong) {
  ++count.tried;
  if (wrong.empty()) return;
  ++count.failed;
  std::printf("FAILED %-24.*s %-18.*s %s\n", static_cast<int>(name(fault).size()),
              name(fault).data(), static_cast<int>(where.size()), where.data(), wrong.c_str());
}

void try_case(const FaultCase& c, Count& count) {
  double slowest_s = 0.0;
  const Count before = count;
  for (const SituationName& s : situations) {
    if (contains(c.elsewhere, s.situation)) {
      ++count.not_possible;
      continue;
    }
    double seen_after_s = 0.0;
    report(count, c.fault, s.name, try_fault(c, s.situation, board_for(c), &seen_after_s));
    if (s.situation != Situation::fault) slowest_s = std::fmax(slowest_s, seen_after_s);
  }
  std::printf("%2d %-24s tried %2d, failed %d, off within %7.1f of %7.1f ms%s%s\n",
              static_cast<int>(c.fault), std::string(name(c.fault)).c_str(),
              count.tried - before.tried, count.failed - before.failed, 1e3 * slowest_s,
              1e3 * c.within.at(1e-3), c.why_not.empty() ? "" : "; elsewhere: ", c.why_not.c_str());
}

}  // namespace

int main() {
  Count count;
  for (const FaultInfo& fault : all_faults()) {
    if (fault.fault == Fault::self_test_failed) {
      double seen_after_s = 0.0;
      report(count, fault.fault, "boot", try_self_test(rough_board(), &seen_after_s));
      std::printf("%2d %-24s tried at boot, twice\n", static_cast<int>(fault.fault),
                  std::string(fault.name).c_str());
      continue;
    }
    const FaultCase* found = nullptr;
    for (const FaultCase& c : fault_cases()) {
      if (c.fault == fault.fault) found = &c;
    }
    if (found == nullptr) {
      std::printf("FAILED %s has no case\n", std::string(fault.name).c_str());
      ++count.failed;
    } else {
      try_case(*found, count);
    }
  }
  std::printf("%zu faults x %zu situations: %d tried, %d cannot come about, %d failed\n",
              all_faults().size(), situations.size(), count.tried, count.not_possible,
              count.failed);
  return count.failed == 0 ? 0 : 1;
}
