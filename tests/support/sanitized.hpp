// Sanitizers are slow: under them a test of many like cases does the first ones. The release build
// does all.
#pragma once

namespace supercoil::test {

inline constexpr bool sanitized = SUPERCOIL_SANITIZED != 0;

}  // namespace supercoil::test
