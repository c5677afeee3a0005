#include "apps/supercoil/board_link.hpp"

#include <cmath>

#include "text/documentation.hpp"

namespace supercoil::operating {

namespace {

/// The antagonist's channel, as in a line; empty: the channel is not the agonist of a joint.
Result<std::string> antagonist_of(BoardLink& board, const std::string& channel) {
  const auto known = board.muscle(channel);
  if (!known) return tl::unexpected(known.error());
  const PlaceInJoint joint = joint_from(*known);
  if (joint.direction < 1 || !joint.has_other()) return "";
  return std::to_string(std::stol(channel) + std::lround(joint.other_channel_offset));
}

std::string fault_text(const std::string& fault) {
  return "fault " + fault + "; see " + documentation_page("faults/" + fault);
}

}  // namespace

BoardLink::Answer arm(BoardLink& board, const std::string& channel) {
  auto answer = board.ask(channel + " arm");
  if (!answer || *answer != "ok") return answer;
  // A probe lasts 50 ms at most; the rest is slack for the machine.
  constexpr int tries = 40;
  for (int i = 0; i < tries; ++i) {
    const auto now = board.status(channel);
    if (!now) return tl::unexpected(now.error());
    if (now->fault != "none") return fault_text(now->fault);
    if (now->state == name(State::armed) && !now->probing) return answer;
    board.wait(std::chrono::milliseconds(50));
  }
  return failure("its heater is still being measured after 2 s");
}

std::string present_fault(BoardLink& board, const std::string& channel) {
  const auto now = board.status(channel);
  if (!now || now->fault == "none") return "";
  return fault_text(now->fault) + "; when its cause is gone: supercoil command " + channel +
         " reset" + board.words();
}

std::string with_present_fault(const std::string& error, BoardLink& board,
                               const std::string& channel) {
  const std::string fault = present_fault(board, channel);
  return fault.empty() ? error : error + ", " + fault;
}

BoardLink::Answer interruption(BoardLink& board, const std::string& channel) {
  return board.status(channel).map([](const BoardLink::Status& now) -> std::string {
    if (now.fault != "none") return fault_text(now.fault);
    return now.state == name(State::disarmed) ? "disarmed" : "by another command";
  });
}

Result<std::vector<ChannelEnding>> endings(BoardLink& board, const std::string& channel) {
  auto ending = board.ending(channel);
  // The known state of the board may be slightly older than its refusal.
  for (int i = 0; ending && ending->result == "running" && i < 10; ++i) {
    board.wait(std::chrono::milliseconds(100));
    ending = board.ending(channel);
  }
  if (!ending) return tl::unexpected(ending.error());
  std::vector<ChannelEnding> all{{channel, *ending}};
  if (ending->result != "found") return all;
  const auto antagonist = antagonist_of(board, channel);
  if (!antagonist) return tl::unexpected(antagonist.error());
  if (antagonist->empty()) return all;
  const auto other_ending = board.ending(*antagonist);
  if (!other_ending) return tl::unexpected(other_ending.error());
  all.push_back({*antagonist, *other_ending});
  return all;
}

Result<std::unique_ptr<BoardLink>> open_link(const std::string& can, const std::string& socket) {
  if (!can.empty()) return std::make_unique<CanBoardLink>(can);
  auto opened = BoardSocket::open(socket);
  if (!opened) return tl::unexpected(opened.error());
  return std::make_unique<LocalBoardLink>(std::move(*opened), socket);
}

}  // namespace supercoil::operating
