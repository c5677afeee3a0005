// Makes each hold time and each limit three times as lax, and asks the matrix whether it notices:
// otherwise the times that it states would prove nothing. Four faults have no number to make lax
// (line_failed, emergency_stop, configuration_invalid, self_test_failed): `fault_mutants` has them.
#include <cstdio>

#include "loop/matrix/lax_limits.hpp"
#include "loop/matrix/notice.hpp"

using namespace supercoil;
using namespace supercoil::test;

int main() {
  int wrong = 0;
  int not_possible = 0;
  for (const LaxLimit& limit : lax_limits()) {
    const std::string seen = noticed(limit.fault, limit.loosen);
    const bool excused = !limit.why_not.empty();
    // An excuse that no longer holds is as wrong as a mutant that goes unnoticed.
    wrong += seen.empty() != excused ? 1 : 0;
    not_possible += excused ? 1 : 0;
    std::printf("%-24s %-24s %s%s\n", limit.name.c_str(), std::string(name(limit.fault)).c_str(),
                seen.empty() && !excused   ? "NOT NOTICED"
                : !seen.empty() && excused ? "NOTICED AFTER ALL: "
                : excused                  ? "cannot be noticed: "
                                           : seen.c_str(),
                limit.why_not.c_str());
  }
  std::printf("%zu limits loosened, %d cannot be noticed, %d wrong\n", lax_limits().size(),
              not_possible, wrong);
  return wrong == 0 ? 0 : 1;
}
