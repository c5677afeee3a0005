// Disables each detector in turn and asks the matrix whether it notices: a matrix that passes
// without a detector proves nothing. Linked with supervisors whose reporting is mutated.
#include <cstdio>

#include "loop/matrix/mutants.hpp"
#include "loop/matrix/notice.hpp"

namespace supercoil {
Fault disabled_detector = Fault::none;
}

using namespace supercoil;
using namespace supercoil::test;

int main() {
  const auto nothing = [](RigSettings&) {};
  int missed = 0;
  for (const FaultInfo& fault : all_faults()) {
    disabled_detector = fault.fault;
    const std::string wrong = noticed(fault.fault, nothing);
    missed += wrong.empty() ? 1 : 0;
    std::printf("without %-24s %s\n", std::string(fault.name).c_str(),
                wrong.empty() ? "NOT NOTICED" : wrong.c_str());
  }
  // The mutation itself does no harm: with no detector disabled, the matrix must notice nothing.
  disabled_detector = Fault::none;
  const std::string harm = noticed(Fault::emergency_stop, nothing);
  if (!harm.empty()) std::printf("the unmutated supervisor fails: %s\n", harm.c_str());
  std::printf("%zu detectors disabled, %d not noticed\n", all_faults().size(), missed);
  return missed == 0 && harm.empty() ? 0 : 1;
}
