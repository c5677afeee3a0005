#include "text/refusal_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "text/command_text.hpp"
#include "text/words.hpp"

namespace supercoil {

namespace {

/// By refusal number; the monitor's page uses them too.
constexpr std::array<std::string_view, refusal_names.size()> general_reasons{
    "",
    "arm it first, or reset its fault; or command the channel that leads its joint or bundle",
    "the fault's cause is still there",
    "too soon after the last reset: try again",
    "self-test, cooling or a probe is not over yet, or a reading is missing",
    "another mode or a probe is under way: let it rest first",
    "the value is out of range",
    "the board has no such channel",
    "another program commands this muscle",
    "the lease has ended: try again",
    "commands were lost: try again",
    "more commands than the board accepts at once: try again",
    "the lease is free but was not granted: try again",
    "the board speaks another version of the protocol: use the matching version of supercoil",
    "unstable on the muscle that is known, or values that contradict each other; nothing changed",
    "the muscle cannot do it: it needs more power than there is, or faster cooling"};

struct VerbReason {
  Verb verb;
  Refusal refusal;
  std::string_view words;
};
constexpr std::string_view comparison_reason =
    "it is accepted while `power` heats steadily; 0, which forgets it, while the muscle rests";
constexpr std::array verb_reasons{
    VerbReason{Verb::arm, Refusal::wrong_state,
               "it is already armed, or has a fault: reset it first"},
    VerbReason{Verb::reset, Refusal::wrong_state, "it has no fault"},
    VerbReason{Verb::renew, Refusal::wrong_state, "no command that heats is active"},
    VerbReason{Verb::rest, Refusal::wrong_state, "it is already resting, or is off"},
    VerbReason{Verb::store, Refusal::not_ready, "the estimate is not trusted yet"},
    VerbReason{Verb::store, Refusal::busy, "the previous tuning is still being stored: try again"},
    VerbReason{Verb::scale, Refusal::wrong_state, "it follows a position: let it rest first"},
    VerbReason{Verb::compare_supply, Refusal::wrong_state, comparison_reason},
    VerbReason{Verb::compare_current, Refusal::wrong_state, comparison_reason},
    VerbReason{Verb::compare_rise, Refusal::wrong_state, comparison_reason},
    VerbReason{Verb::knot, Refusal::wrong_state, "it follows no position, or the motion has ended"},
    VerbReason{Verb::start, Refusal::wrong_state, "no motion is loaded"},
    VerbReason{Verb::start, Refusal::not_ready,
               "its set point differs from the start of the motion"},
    VerbReason{Verb::start, Refusal::out_of_range, "the start time has passed"},
    VerbReason{
        Verb::scale, Refusal::unsuitable,
        "a joint's scale is its m_per_count and lever_m, a bundle's that of the channel that "
        "leads"}};

Verb verb_of(std::string_view line) {
  next_word(line);
  const auto found = std::ranges::find(verb_names, next_word(line));
  return found == verb_names.end() ? Verb::none : static_cast<Verb>(found - verb_names.begin());
}

}  // namespace

std::string_view refusal_words(Refusal refusal, Verb verb) {
  const auto found = std::ranges::find_if(verb_reasons, [&](const VerbReason& one) {
    return one.verb == verb && one.refusal == refusal;
  });
  return found != verb_reasons.end() ? found->words
                                     : general_reasons.at(static_cast<std::size_t>(refusal));
}

std::string answer_with_reason(const Reply& reply, Verb verb) {
  std::string text = answer_text(reply.refusal, reply.nearest);
  if (reply.refusal == Refusal::none || !std::isnan(reply.nearest)) return text;
  return text + ": " + std::string(refusal_words(reply.refusal, verb));
}

std::string answer_with_reason(std::string_view line, std::string_view answer) {
  const auto reply = parse_answer(answer);
  const bool bare = reply && answer == answer_text(reply->refusal, NAN);
  return bare ? answer_with_reason(*reply, verb_of(line)) : std::string(answer);
}

}  // namespace supercoil
