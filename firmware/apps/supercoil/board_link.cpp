#include "apps/supercoil/board_link.hpp"

namespace supercoil::operating {

BoardLink::Answer arm(BoardLink& board, const std::string& channel) {
  auto answer = board.ask(channel + " arm");
  if (!answer || *answer != "ok") return answer;
  // A probe lasts 50 ms at most; the rest is the machine's.
  constexpr int tries = 40;
  for (int i = 0; i < tries; ++i) {
    const auto now = board.status(channel);
    if (!now) return tl::unexpected(now.error());
    if (now->fault != "none") return "fault " + now->fault + "; docs/faults/" + now->fault + ".md";
    if (now->state == name(State::armed) && !now->probing) return answer;
    board.wait(std::chrono::milliseconds(50));
  }
  return tl::unexpected<std::string>("its heater is still being measured after 2 s");
}

tl::expected<std::unique_ptr<BoardLink>, std::string> open_link(const std::string& can,
                                                                const std::string& socket) {
  if (!can.empty()) return std::make_unique<CanBoardLink>(can);
  auto opened = BoardSocket::open(socket);
  if (!opened) return tl::unexpected(opened.error());
  return std::make_unique<LocalBoardLink>(std::move(*opened));
}

}  // namespace supercoil::operating
