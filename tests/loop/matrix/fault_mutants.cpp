// Disables each detector in turn and asks the matrix whether it notices: a matrix that passes
// without a detector proves nothing. Linked with supervisors whose reporting is mutated.
#include <cstdio>

#include "loop/matrix/mutants.hpp"
#include "loop/matrix/trial.hpp"

namespace supercoil {
Fault disabled_detector = Fault::none;
}

using namespace supercoil;
using namespace supercoil::test;

namespace {

/// What the matrix says first about a board with this detector disabled.
std::string noticed(Fault fault) {
  double unused_s = 0.0;
  if (fault == Fault::self_test_failed) return try_self_test(rough_board(), &unused_s);
  for (const FaultCase& c : fault_cases()) {
    if (c.fault != fault) continue;
    for (const SituationName& s : situations) {
      bool possible = s.situation != Situation::fault;
      for (const Situation elsewhere : c.elsewhere)
        possible = possible && elsewhere != s.situation;
      if (!possible) continue;
      const std::string wrong = try_fault(c, s.situation, board_for(c), &unused_s);
      const bool for_lack_of_it =
          wrong.starts_with("not detected") || wrong.starts_with("detected as");
      if (for_lack_of_it) return std::string(s.name) + ": " + wrong;
    }
  }
  return "";
}

}  // namespace

int main() {
  int missed = 0;
  for (const FaultInfo& fault : all_faults()) {
    disabled_detector = fault.fault;
    const std::string wrong = noticed(fault.fault);
    missed += wrong.empty() ? 1 : 0;
    std::printf("without %-24s %s\n", std::string(fault.name).c_str(),
                wrong.empty() ? "NOT NOTICED" : wrong.c_str());
  }
  // The mutation itself does no harm: without any, nothing is to be noticed.
  disabled_detector = Fault::none;
  const std::string harm = noticed(Fault::emergency_stop);
  if (!harm.empty()) std::printf("the unmutated supervisor fails: %s\n", harm.c_str());
  std::printf("%zu detectors disabled, %d not noticed\n", all_faults().size(), missed);
  return missed == 0 && harm.empty() ? 0 : 1;
}
