// The sources that a program was built from.
#pragma once

#include <string_view>

namespace supercoil {

/// As toolchain/version prints it: 0.2.0 for a release, else 0.2.0+git20261122.150233.2780ebf with
/// time (UTC) and hash of the commit.
std::string_view program_version();

}  // namespace supercoil
