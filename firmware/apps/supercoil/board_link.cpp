#include "apps/supercoil/board_link.hpp"

#include <cmath>

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

tl::expected<std::string, std::string> antagonist_of(BoardLink& board, const std::string& channel) {
  const auto known = board.muscle(channel);
  if (!known) return tl::unexpected(known.error());
  const double offset = (*known)[known_joint_other_node_offset];
  if (!((*known)[known_joint_lever] > 0.0) || !std::isfinite(offset)) return "";
  return std::to_string(std::stol(channel) + std::lround(offset));
}

tl::expected<std::unique_ptr<BoardLink>, std::string> open_link(const std::string& can,
                                                                const std::string& socket) {
  if (!can.empty()) return std::make_unique<CanBoardLink>(can);
  auto opened = BoardSocket::open(socket);
  if (!opened) return tl::unexpected(opened.error());
  return std::make_unique<LocalBoardLink>(std::move(*opened));
}

}  // namespace supercoil::operating
