#include "loop/matrix/notice.hpp"

#include "loop/matrix/cases/cases.hpp"
#include "loop/matrix/joint_trial.hpp"

namespace supercoil::test {

std::string noticed(Fault fault, const std::function<void(RigSettings&)>& change) {
  double unused_s = 0.0;
  if (fault == Fault::self_test_failed) {
    RigSettings settings = rough_board();
    change(settings);
    return try_self_test(settings, &unused_s);
  }
  for (const FaultCase& c : joint_cases()) {
    if (c.fault == fault) return try_joint(c, Situation::pi);
  }
  for (const FaultCase& c : fault_cases()) {
    if (c.fault != fault) continue;
    for (const SituationName& s : situations) {
      if (s.situation == Situation::fault || !possible(c, s.situation)) continue;
      RigSettings settings = board_for(c);
      change(settings);
      const std::string wrong = try_fault(c, s.situation, settings, &unused_s);
      const bool for_lack_of_it = wrong.starts_with("not detected") ||
                                  wrong.starts_with("detected as") ||
                                  wrong.starts_with("the board's fault is") ||
                                  wrong.starts_with("the supply is still closed");
      if (for_lack_of_it) return std::string(s.name) + ": " + wrong;
    }
  }
  return "";
}

}  // namespace supercoil::test
