// Setup's changes to the board's file, and their undoing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/options.hpp"
#include "config/board_config.hpp"

namespace supercoil::operating {

/// Suffix of the copy of a board's file from before setup changed it; ".before-setup-2" before the
/// second change, and so on.
inline constexpr const char* before_setup = ".before-setup";
/// path, or "path-2" and so on if it exists already.
std::string free_name(const std::string& path);

/// The file's text. If the file is not TOML, the error consists of whole lines.
Result<std::string> read_board_text(const std::string& config);
/// "board.toml has no channel 3, but 2"; empty: it has that channel, or the file does not say.
std::string missing_channel(const std::string& config, int channel);
/// Puts entries of the channel that is set up into the text, and writes the file only if it is
/// valid then. The old file is kept, and the record notes that the step wrote it. The error
/// consists of whole lines.
Result<config::BoardConfig> write_entries(const SetupOptions& options, const std::string& step,
                                          const std::string& text,
                                          const std::vector<Entry>& entries);

/// Whether a step wrote the file: then its findings contain keys of the file, which have dots.
bool wrote_file(const nlohmann::ordered_json& found);

/// What a step left on the board, outside the file.
struct OnBoard {
  std::string what;
  std::string forgotten_by;  ///< a command
};

struct Undone {
  int channel = 1;
  std::string step;     ///< the step that wrote the file
  std::string kept_as;  ///< the file as it was until now
  std::vector<OnBoard> on_board;
};

/// Undoes the last change of the channel that is set up, with its step and later ones. anyway:
/// whether to go on although the file is not as setup wrote it; gets the reason. The error says
/// what could not be done; the file is then unchanged.
Result<Undone> undo_setup(const SetupOptions& options,
                          const std::function<bool(const std::string& why)>& anyway);

/// "board.toml is as it was before describe of channel 1; …"
std::string undone_text(const std::string& config, const Undone& undone);

}  // namespace supercoil::operating
