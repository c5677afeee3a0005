// A board's configuration: either every mistake is named, or the board can be run and described.
#include <string>

#include "config/board_config.hpp"
#include "config/describe.hpp"
#include "fuzz/problems.hpp"

using namespace supercoil;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text(data, size));
  const auto board = config::parse_board_config(text, "board.toml");
  if (!board) {
    fuzz::require_named(board.error(), "board.toml", text);
    return 0;
  }
  fuzz::require(!check(board->settings), "what is accepted passes the loop's own check");
  const std::size_t channels = board->settings.channels.size();
  fuzz::require(board->wiring.channels.size() == channels, "every channel is wired");
  fuzz::require(board->labels.size() == channels, "every channel has a name");
  fuzz::require(!config::describe(*board).empty(), "what is accepted can be described");
  return 0;
}
