#include "apps/supercoil/play/motion_link.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

#include "text/number_text.hpp"
#include "text/words.hpp"

namespace supercoil::operating {

namespace {

/// What answer_text() of the board's command_text.hpp says; the error: it says something else.
MotionLink::Answered answer_in(const std::string& told) {
  if (told == "ok") return MotionLink::Answer{Refusal::none, NAN};
  constexpr std::string_view refused = "refused: ";
  std::string_view rest = told;
  if (rest.starts_with(refused)) {
    rest.remove_prefix(refused.size());
    const std::string_view word = rest.substr(0, rest.find(';'));
    const auto found = std::ranges::find(refusal_names, word);
    if (found != refusal_names.end()) {
      const auto refusal = static_cast<Refusal>(found - refusal_names.begin());
      rest.remove_prefix(std::min(rest.size(), word.size() + 1));
      const std::string_view nearest_word = next_word(rest);
      double nearest = NAN;
      std::from_chars(nearest_word.data(), nearest_word.data() + nearest_word.size(), nearest);
      return MotionLink::Answer{refusal, nearest};
    }
  }
  return tl::unexpected(told);
}

}  // namespace

MotionLink::Answered CanMotionLink::ask(Verb verb, double value) {
  const auto answer = commander_.ask(verb, value);
  if (!answer) return tl::unexpected(answer.error());
  return Answer{*answer, *answer == Refusal::out_of_range ? commander_.nearest() : NAN};
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
  return socket_.ask(channel_ + " " + words).and_then(answer_in);
}

MotionLink::Answered LocalMotionLink::ask(Verb verb, double value) {
  const std::string word(name(verb));
  return command(verb == Verb::position ? word + " " + shortest_text(value) : word);
}

MotionLink::Played LocalMotionLink::command_then_status(const std::string& words) {
  const auto answer = command(words);
  if (!answer) return tl::unexpected(answer.error());
  auto played = playback();
  if (played) played->refusal = answer->refusal;
  return played;
}

MotionLink::Played LocalMotionLink::add_knot(double after_s, const control::Knot& knot) {
  return command_then_status("knot " + shortest_text(after_s) + " " +
                             shortest_text(knot.position_m) + " " +
                             shortest_text(knot.velocity_m_per_s));
}

/// A time that is over is all that it can be out of range by.
MotionLink::Played LocalMotionLink::start(const Start& start) {
  auto played = command_then_status("start " + shortest_text(start.board_s + start.after_s));
  if (played && played->refusal == Refusal::out_of_range)
    return tl::unexpected(std::string("the start was told too late: this machine was busy"));
  return played;
}

tl::expected<LocalMotionLink::Status, std::string> LocalMotionLink::read_status() {
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
  return tl::unexpected("nothing is told of its trajectory: " + *lines);
}

MotionLink::Played LocalMotionLink::playback() {
  return read_status().map([](const Status& status) { return status.played; });
}

tl::expected<double, std::string> LocalMotionLink::board_s() {
  return read_status().map([](const Status& status) { return status.board_s; });
}

}  // namespace supercoil::operating
