// The tick of these tests' board.
#pragma once

namespace supercoil::test {

inline constexpr double tick_s = 1e-3;

}  // namespace supercoil::test
