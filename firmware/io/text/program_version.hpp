// Of which sources a program was built.
#pragma once

#include <string_view>

namespace supercoil {

/// As toolchain/version tells it: 0.2.0 of a release, else 0.2.0+git20261122.150233.2780ebf with
/// time (UTC) and hash of the commit.
std::string_view program_version();

}  // namespace supercoil
