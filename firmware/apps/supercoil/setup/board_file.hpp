// The board's file, as setup changes it, and takes back what it changed.
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

/// Behind a board's file: the file as it was before setup changed it; before the second change
/// ".before-setup-2", and so on.
inline constexpr const char* before_setup = ".before-setup";
/// path, or "path-2" and so on where that is there already.
std::string free_name(const std::string& path);

/// Its text. The error, of a file that is no TOML, is whole lines.
Result<std::string> read_board_text(const std::string& config);
/// "board.toml has no channel 3, but 2"; empty: it has that one, or is no file that says.
std::string missing_channel(const std::string& config, int channel);
/// Puts entries into that text, of the channel that is set up, and writes the file only if it is in
/// order then; what it was before is kept, and the record tells that the step wrote it. The error
/// is whole lines.
Result<config::BoardConfig> write_entries(const SetupOptions& options, const std::string& step,
                                          const std::string& text,
                                          const std::vector<Entry>& entries);

/// That a step wrote the file: what it found has keys of it, which have dots.
bool wrote_file(const nlohmann::ordered_json& found);

/// What a step left on the board, which has no part in the file.
struct OnBoard {
  std::string what;
  std::string forgotten_by;  ///< a command
};

struct Undone {
  int channel = 1;
  std::string step;     ///< that had written
  std::string kept_as;  ///< the file as it was until now
  std::vector<OnBoard> on_board;
};

/// The last change of the channel that is set up, with its step and those behind it. anyway:
/// whether to go on where the file is not as setup wrote it, whose reason it is given. The error
/// says what could not be done; the file is as it was then.
Result<Undone> undo_setup(const SetupOptions& options,
                          const std::function<bool(const std::string& why)>& anyway);

/// "board.toml is as it was before describe of channel 1; …"
std::string undone_text(const std::string& config, const Undone& undone);

}  // namespace supercoil::operating
