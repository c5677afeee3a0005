#include "apps/supercoil/setup/heated.hpp"

#include <cmath>

#include "text/command_text.hpp"
#include "text/number_text.hpp"
#include "text/refusal_words.hpp"

namespace supercoil::operating {

namespace {

constexpr std::chrono::milliseconds heat_renewal{50};
constexpr int power_digits = 3;

}  // namespace

Heated::Heated(BoardLink& board, const std::string& channel, Operator& user)
    : board_(board), channel_(channel), heated_by_(channel), user_(user) {
  const auto known = board.muscle(channel);
  const double offset = known ? (*known)[known_bundle_leader_node_offset] : NAN;
  if (std::isfinite(offset)) heated_by_ = std::to_string(std::stol(channel) + std::lround(offset));
}

Heated::~Heated() {
  static_cast<void>(ask("rest"));
  if (const auto off = ask("disarm"); !off)
    user_.show("the muscle may be hot: " + off.error().text());
}

Heated::Done Heated::ask(const std::string& what) {
  return ask_channel(channel_, what);
}

Heated::Done Heated::ask_channel(const std::string& channel, const std::string& what) {
  const auto answer = board_.ask(channel + " " + what);
  if (!answer) return tl::unexpected(answer.error());
  if (*answer == "ok") return {};
  // Whoever asks explains a refused value.
  const bool explained = refuses(*answer, Refusal::out_of_range);
  return failure(what + ": " +
                 (explained ? *answer : answer_with_reason(channel + " " + what, *answer)));
}

Heated::Done Heated::heat(double power_W) {
  if (user_.interrupted()) return failure("interrupted");
  return ask_channel(heated_by_, "power " + number_text(power_W, power_digits));
}

Heated::Done Heated::hold(double power_W, std::chrono::milliseconds time) {
  for (auto held = std::chrono::milliseconds(0); held < time; held += heat_renewal) {
    if (auto heated = heat(power_W); !heated) return heated;
    board_.wait(heat_renewal);
  }
  return {};
}

}  // namespace supercoil::operating
