// Does the matrix notice that something protects less than it should?
#pragma once

#include <functional>
#include <string>

#include "loop/matrix/fault_case.hpp"

namespace supercoil::test {

/// The matrix's first complaint, at 1 kHz, about a board whose settings were changed; empty when it
/// notices nothing. A trial that fails for a reason other than missing protection does not count.
std::string noticed(Fault fault, const std::function<void(RigSettings&)>& change);

}  // namespace supercoil::test
