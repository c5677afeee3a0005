#include "apps/supercoil/play/motion_link.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "text/command_text.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

MotionLink::Answered CanMotionLink::ask(Verb verb, double value) {
  const auto answer = commander_.ask(verb, value);
  if (!answer) return tl::unexpected(answer.error());
  return Reply(*answer, *answer == Refusal::out_of_range ? commander_.nearest() : NAN);
}

MotionLink::Played CanMotionLink::add_knot(double after_s, const control::Knot& knot) {
  return commander_.add_knot(after_s, knot);
}

MotionLink::Played CanMotionLink::start(const Start& start) {
  return commander_.start_at_sync(start.sync, start.after_s);
}

void CanMotionLink::send_sync(std::uint8_t number, double master_time_s) {
  static_cast<void>(commander_.send_sync(number, master_time_s));
}

MotionLink::Answered LocalMotionLink::command(const std::string& words) {
  const auto answer = socket_.ask(channel_ + " " + words);
  if (!answer) return tl::unexpected(answer.error());
  const auto reply = parse_answer(*answer);
  if (!reply) return failure(unmarked(*answer));
  return *reply;
}

MotionLink::Answered LocalMotionLink::ask(Verb verb, double value) {
  const std::string word(name(verb));
  return command(verb == Verb::position ? word + " " + shortest_text(value) : word);
}

MotionLink::Played LocalMotionLink::command_then_status(const std::string& words) {
  const auto answer = command(words);
  if (!answer) return tl::unexpected(answer.error());
  if (!std::isnan(answer->nearest)) return failure(answer_text(answer->refusal, answer->nearest));
  auto played = playback();
  if (played) played->refusal = answer->refusal;
  return played;
}

MotionLink::Played LocalMotionLink::add_knot(double after_s, const control::Knot& knot) {
  return command_then_status("knot " + shortest_text(after_s) + " " +
                             shortest_text(knot.position_m) + " " +
                             shortest_text(knot.velocity_m_per_s));
}

/// Out of range can only mean that the start time has passed.
MotionLink::Played LocalMotionLink::start(const Start& start) {
  auto played = command_then_status("start " + shortest_text(start.board_s + start.after_s));
  if (played && played->refusal == Refusal::out_of_range)
    return failure("the start was sent too late: this machine was busy");
  return played;
}

Result<LocalMotionLink::Status> LocalMotionLink::read_status() {
  const auto lines = socket_.ask("playback");
  if (!lines) return tl::unexpected(lines.error());
  std::istringstream text(*lines);
  std::string channel, state;
  int room = 0;
  Status status{{Refusal::none, PlaybackState::empty, 0, NAN}, NAN};
  while (text >> channel >> state >> room >> status.played.buffered_s >> status.board_s) {
    const auto found = std::ranges::find(playback_state_names, state);
    if (channel != channel_ || found == playback_state_names.end()) continue;
    status.played.state = static_cast<PlaybackState>(found - playback_state_names.begin());
    status.played.room = static_cast<std::uint8_t>(room);
    return status;
  }
  return failure("no state of its trajectory is reported: " + unmarked(*lines));
}

MotionLink::Played LocalMotionLink::playback() {
  return read_status().map([](const Status& status) { return status.played; });
}

Result<double> LocalMotionLink::board_s() {
  return read_status().map([](const Status& status) { return status.board_s; });
}

}  // namespace supercoil::operating
