// Every fault × everything that a channel can be doing, and some of them at the slowest and the
// fastest rate. Prints what was tried; its exit status is the verdict.
#include <cstdio>
#include <span>

#include "loop/matrix/trial.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

struct Count {
  int tried = 0;
  int failed = 0;
  int not_possible = 0;
};

/// One rate, and the situations tried at it.
struct Run {
  double rate_Hz;
  std::span<const SituationName> situations;
};

void report(Count& count, Fault fault, std::string_view where, const std::string& wrong) {
  ++count.tried;
  if (wrong.empty()) return;
  ++count.failed;
  std::printf("FAILED %-24s %-18s %s\n", std::string(name(fault)).c_str(),
              std::string(where).c_str(), wrong.c_str());
}

void try_case(const FaultCase& c, const Run& run, Count& count) {
  double slowest_s = 0.0;
  const Count before = count;
  for (const SituationName& s : run.situations) {
    if (!possible(c, s.situation)) {
      ++count.not_possible;
      continue;
    }
    double seen_after_s = 0.0;
    report(count, c.fault, s.name,
           try_fault(c, s.situation, board_for(c, run.rate_Hz), &seen_after_s));
    if (s.situation != Situation::fault) slowest_s = std::fmax(slowest_s, seen_after_s);
  }
  const std::string how = c.how.empty() ? "" : "; when " + c.how;
  const std::string why_not = c.why_not.empty() ? "" : "; elsewhere: " + c.why_not;
  std::printf("%2d %-24s tried %2d, failed %d, off within %7.1f of %7.1f ms%s%s\n",
              static_cast<int>(c.fault), std::string(name(c.fault)).c_str(),
              count.tried - before.tried, count.failed - before.failed, 1e3 * slowest_s,
              1e3 * c.within.at(1.0 / run.rate_Hz), how.c_str(), why_not.c_str());
}

void try_fault_of(Fault fault, const Run& run, Count& count) {
  if (fault == Fault::self_test_failed) {
    double seen_after_s = 0.0;
    report(count, fault, "boot", try_self_test(rough_board(run.rate_Hz), &seen_after_s));
    std::printf("%2d %-24s tried at boot, twice\n", static_cast<int>(fault),
                std::string(name(fault)).c_str());
    return;
  }
  if (fault == Fault::muscle_loose) {
    std::printf("%2d %-24s tried on a joint, by joint_matrix\n", static_cast<int>(fault),
                std::string(name(fault)).c_str());
    return;
  }
  bool found = false;
  for (const FaultCase& c : fault_cases()) {
    if (c.fault != fault) continue;
    try_case(c, run, count);
    found = true;
  }
  if (found) return;
  std::printf("FAILED %s has no case\n", std::string(name(fault)).c_str());
  ++count.failed;
}

int failed(const Run& run) {
  std::printf("at %.0f Hz\n", run.rate_Hz);
  Count count;
  for (const FaultInfo& fault : all_faults())
    try_fault_of(fault.fault, run, count);
  std::printf(
      "%zu faults, %zu ways x %zu situations: %d tried, %d cannot come about, %d failed\n\n",
      all_faults().size(), fault_cases().size(), run.situations.size(), count.tried,
      count.not_possible, count.failed);
  return count.failed;
}

}  // namespace

int main() {
  // Every fault can occur in at least one of these.
  constexpr std::array<SituationName, 3> at_other_rates{{{Situation::arming, "arming"},
                                                         {Situation::armed, "armed"},
                                                         {Situation::mrac, "active, mrac"}}};
  const int wrong =
      failed({1e3, situations}) + failed({100.0, at_other_rates}) + failed({10e3, at_other_rates});
  return wrong == 0 ? 0 : 1;
}
