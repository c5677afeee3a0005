// The tables of a stored set that hold what was tuned: [controller_0] and so on, [chosen].
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "board/learned.hpp"

namespace supercoil::storage {

/// Only what differs from the configuration has a line; empty: nothing does.
std::string encode_tuning(const board::StoredTuning& tuning);

bool is_tuning_table(std::string_view table);
bool is_tuning_key(std::string_view table, std::string_view key);

/// Whatever of it the file has. The message says which value is not a number.
std::optional<std::string> read_tuning(const toml::table& file, board::StoredTuning& tuning);

}  // namespace supercoil::storage
