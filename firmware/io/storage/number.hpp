// Numbers of a stored file, written so that they read back bit for bit.
#pragma once

#include <optional>
#include <string>

#include <toml++/toml.h>

namespace supercoil::storage {

/// With a point or exponent: "-0" would be read as the integer 0, without its sign.
std::string toml_number(double value);
/// Returns what is wrong, or nothing with the number in value.
std::optional<std::string> read_number(const toml::node* node, double& value);

}  // namespace supercoil::storage
