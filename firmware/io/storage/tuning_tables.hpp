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

/// Whether a stored set may have this table for its tuning: controller_0 to _3, estimator_0 to _3,
/// chosen.
bool is_tuning_table(std::string_view table);
/// Whether that table may have this key: one of control::tunables() that its kind can have.
bool is_tuning_key(std::string_view table, std::string_view key);

/// Reads the tuned values that the file has. The message says which value is not a number.
std::optional<std::string> read_tuning(const toml::table& file, board::StoredTuning& tuning);

}  // namespace supercoil::storage
