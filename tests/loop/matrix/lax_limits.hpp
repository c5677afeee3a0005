// Every hold time and limit of a detector, made three times as lax.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "loop/support/rig.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

struct LaxLimit {
  std::string name;
  Fault fault;  ///< the fault that it delays or hides
  std::function<void(RigSettings&)> loosen;
  std::string why_not = {};  ///< why the matrix cannot notice it
};

const std::vector<LaxLimit>& lax_limits();

}  // namespace supercoil::test
