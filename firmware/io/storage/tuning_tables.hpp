// The tables of a stored set that hold tuned values: [controller_0] and so on, [chosen].
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "board/learned.hpp"

namespace supercoil::storage {

/// Only values that differ from the configuration have a line; empty: none differs.
std::string encode_tuning(const board::StoredTuning& tuning);

bool is_tuning_table(std::string_view table);
bool is_tuning_key(std::string_view table, std::string_view key);

/// Reads the tuned values that the file has. The message says which value is not a number.
std::optional<std::string> read_tuning(const toml::table& file, board::StoredTuning& tuning);

}  // namespace supercoil::storage
