// Every fault on a board whose two channels are a joint: whatever is wrong with one muscle, both go
// cold in the same tick and report the same cause. Its exit status is the verdict.
#include <cstdio>

#include "loop/matrix/cases/cases.hpp"
#include "loop/matrix/joint_trial.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

/// What both channels do, and the situation of a single channel that is most like it.
struct JointSituation {
  Situation like;
  const char* name;
};
constexpr std::array<JointSituation, 3> joint_situations{
    {{Situation::disarmed, "disarmed"}, {Situation::armed, "armed"}, {Situation::pi, "following"}}};

}  // namespace

int main() {
  int tried = 0;
  int failed = 0;
  int not_possible = 0;
  std::vector<FaultCase> cases = fault_cases();
  for (const FaultCase& c : joint_cases())
    cases.push_back(c);
  for (const FaultCase& c : cases) {
    for (const JointSituation& s : joint_situations) {
      if (!possible(c, s.like)) {
        ++not_possible;
        continue;
      }
      ++tried;
      const std::string wrong = try_joint(c, s.like);
      if (wrong.empty()) continue;
      ++failed;
      std::printf("FAILED %-24s %-10s %s %s\n", std::string(name(c.fault)).c_str(), s.name,
                  c.how.c_str(), wrong.c_str());
    }
  }
  std::printf("a joint: %zu ways x %zu situations: %d tried, %d cannot come about, %d failed\n",
              cases.size(), joint_situations.size(), tried, not_possible, failed);
  return failed == 0 ? 0 : 1;
}
