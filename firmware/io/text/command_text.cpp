#include "text/command_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <utility>

#include "text/nearest.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace supercoil {

namespace {

constexpr std::string_view refused = "refused: ";

template <class Number>
std::optional<Number> number(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::vector<std::string> known_verbs() {
  std::vector<std::string> all;
  for (const std::string_view verb : plain_verb_names) {
    if (verb != name(Verb::none)) all.emplace_back(verb);
  }
  all.insert(all.end(), {"clear", "store tuning", "clear tuning"});
  return all;
}

std::string no_command(std::string_view word, std::string_view addressed) {
  if (word.empty()) {
    return "no command after the " + std::string(addressed) +
           "; there are: " + joined(known_verbs());
  }
  return "'" + std::string(word) + "' is not a command; " +
         suggestion_or_all(word, known_verbs(), "there are");
}

Result<double> finite_number(std::string_view word, Verb verb, std::string_view needs) {
  const auto value = number<double>(word);
  const bool is_place = verb == Verb::controller || verb == Verb::estimator || verb == Verb::tune;
  if (value && std::isfinite(*value) && (!is_place || *value == std::floor(*value))) return *value;
  const std::string what = std::string(name(verb)) + " needs " + std::string(needs);
  return failure(word.empty() ? what : what + "; '" + std::string(word) + "' is not one");
}

/// typed: the verb's word.
std::string unexpected_word(std::string_view typed, Verb verb, std::string_view rest) {
  return std::string(typed) +
         (needed_value(verb).empty() ? " takes no value: leave out '"
                                     : " takes one value: leave out '") +
         std::string(rest) + "'";
}

}  // namespace

Result<std::uint8_t> parse_channel(std::string_view word, std::size_t channels,
                                   std::string_view addressed) {
  const auto channel = number<std::size_t>(word);
  if (channel && *channel >= 1 && *channel <= channels)
    return static_cast<std::uint8_t>(*channel - 1);
  const bool no_number = !word.empty() && !number<double>(word);
  return failure(std::string(addressed) + " '" + std::string(word) + "': must be 1 to " +
                     std::to_string(channels) +
                     (no_number ? "; it comes first, as in '1 arm'" : ""),
                 std::errc::invalid_argument);
}

std::string value_problem(Verb verb, double value) {
  return verb == Verb::power && value < 0.0 ? "power must be 0 W or more" : "";
}

std::string_view needed_value(Verb verb) {
  switch (verb) {
    case Verb::position:
    case Verb::scale:
      return "a number, in m";
    case Verb::power:
      return "a number, in W";
    case Verb::compare_supply:
      return "a number, in V";
    case Verb::compare_current:
      return "a number, in A";
    case Verb::compare_rise:
      return "a number, in K";
    case Verb::controller:
    case Verb::estimator:
    case Verb::tune:
      return "a whole number, its place in the configuration from 0";
    default:
      return "";
  }
}

Result<Command> parse_command(std::string_view text, std::size_t channels,
                              std::string_view addressed) {
  const auto channel = parse_channel(next_word(text), channels, addressed);
  if (!channel) return tl::unexpected(channel.error());
  const std::string_view verb_word = next_word(text);
  // `clear` is the word for storing nothing.
  const bool clears = verb_word == "clear";
  const auto found = std::find(plain_verb_names.begin(), plain_verb_names.end(),
                               clears ? name(Verb::store) : verb_word);
  const Verb verb = found == plain_verb_names.end()
                        ? Verb::none
                        : static_cast<Verb>(std::distance(plain_verb_names.begin(), found));
  if (verb == Verb::none) return failure(no_command(verb_word, addressed));
  const bool stores = verb == Verb::store && !clears;
  Command command{*channel, verb, stores ? 1.0 : 0.0};
  std::string_view value_word = next_word(text);
  if (verb == Verb::store && value_word == "tuning") {
    command.value = stores ? store_tuning : clear_tuning;
    value_word = next_word(text);
  }
  const std::string_view needs = needed_value(verb);
  if (!needs.empty()) {
    const auto value = finite_number(value_word, verb, needs);
    if (!value) return tl::unexpected(value.error());
    command.value = *value;
  }
  if (std::string problem = value_problem(verb, command.value); !problem.empty())
    return failure(std::move(problem));
  const std::string_view rest = needs.empty() ? value_word : next_word(text);
  if (!rest.empty()) return failure(unexpected_word(verb_word, verb, rest));
  return command;
}

std::optional<Result<Command>> parse_trajectory_command(std::string_view text,
                                                        std::size_t channels) {
  const std::string_view channel_word = next_word(text);
  const std::string_view verb_word = next_word(text);
  const bool is_knot = verb_word == name(Verb::knot);
  if (!is_knot && verb_word != name(Verb::start)) return std::nullopt;
  const auto channel = parse_channel(channel_word, channels);
  if (!channel) return tl::unexpected(channel.error());
  Command command{*channel, is_knot ? Verb::knot : Verb::start};
  const std::array<double*, 1> of_start{&command.value};
  double after_s = 0.0;
  double velocity_m_per_s = 0.0;
  const std::array<double*, 3> of_knot{&after_s, &command.value, &velocity_m_per_s};
  const std::string_view needs =
      is_knot ? "three numbers: s after the previous one, m, m/s" : "a time of the board, in s";
  for (double* wanted : is_knot ? std::span<double* const>(of_knot) : std::span(of_start)) {
    const auto value = finite_number(next_word(text), command.verb, needs);
    if (!value) return tl::unexpected(value.error());
    *wanted = *value;
  }
  constexpr double min_after_s = 1e-3;
  constexpr double max_float = std::numeric_limits<float>::max();
  if (is_knot && after_s != 0.0 && !(after_s >= min_after_s && after_s <= max_float)) {
    return failure(shortest_text(after_s) +
                   " s after the previous one: must be 0.001 or more, or 0 of the first");
  }
  if (std::abs(velocity_m_per_s) > max_float)
    return failure(shortest_text(velocity_m_per_s) + " m/s is not a valid velocity");
  command.after_s = static_cast<float>(after_s);
  command.velocity_m_per_s = static_cast<float>(velocity_m_per_s);
  const std::string_view rest = next_word(text);
  if (!rest.empty()) {
    return failure(std::string(name(command.verb)) + " takes no further value: leave out '" +
                   std::string(rest) + "'");
  }
  return command;
}

std::string answer_text(Refusal refusal, double nearest) {
  if (refusal == Refusal::none) return "ok";
  std::ostringstream text;
  text << refused << name(refusal);
  if (!std::isnan(nearest)) text << "; " << nearest << " would be obeyed";
  return text.str();
}

std::optional<Reply> parse_answer(std::string_view text) {
  if (text == "ok") return Refusal::none;
  if (!text.starts_with(refused)) return std::nullopt;
  text.remove_prefix(refused.size());
  const std::string_view word = text.substr(0, text.find_first_of(";:"));
  const auto found = std::ranges::find(refusal_names, word);
  const auto refusal = static_cast<Refusal>(found - refusal_names.begin());
  if (found == refusal_names.end() || refusal == Refusal::none) return std::nullopt;
  text.remove_prefix(word.size());
  if (!text.starts_with(';')) return refusal;
  text.remove_prefix(1);
  return Reply(refusal, number<double>(next_word(text)).value_or(NAN));
}

bool refuses(std::string_view text, Refusal why) {
  const auto reply = parse_answer(text);
  return reply && reply->refusal == why;
}

}  // namespace supercoil
