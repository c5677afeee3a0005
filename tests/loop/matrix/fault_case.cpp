#include "loop/matrix/fault_case.hpp"

#include "loop/matrix/cases/cases.hpp"

namespace supercoil::test {

const std::vector<FaultCase>& fault_cases() {
  static const std::vector<FaultCase> all = [] {
    std::vector<FaultCase> cases;
    for (const auto& group :
         {sensor_cases(), heater_cases(), muscle_cases(), board_cases(), command_cases()}) {
      cases.insert(cases.end(), group.begin(), group.end());
    }
    return cases;
  }();
  return all;
}

bool possible(const FaultCase& c, Situation situation) {
  for (const Situation elsewhere : c.elsewhere) {
    if (elsewhere == situation) return false;
  }
  return true;
}

}  // namespace supercoil::test
