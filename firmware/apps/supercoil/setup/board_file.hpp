// The board's file, as setup changes it.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "config/board_config.hpp"

namespace supercoil::operating {

/// The file as it was before setup changed it first.
std::string kept_config(const std::string& config);

/// Its text. The error, of a file that is no TOML, is whole lines.
tl::expected<std::string, std::string> read_board_text(const std::string& config);
/// Puts entries into that text, of the channel that is set up, and writes the file only if it is in
/// order then. The error is whole lines.
tl::expected<config::BoardConfig, std::string> write_entries(const SetupOptions& options,
                                                             const std::string& text,
                                                             const std::vector<Entry>& entries);

/// The file as it was, and no record. The error says what could not be done.
tl::expected<void, std::string> undo_setup(const SetupOptions& options);

}  // namespace supercoil::operating
