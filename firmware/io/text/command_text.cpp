#include "text/command_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "text/words.hpp"

namespace supercoil {

namespace {

/// The others take none.
bool has_value(Verb verb) {
  return verb == Verb::position || verb == Verb::power || verb == Verb::scale ||
         verb == Verb::controller || verb == Verb::estimator || verb == Verb::compare_supply ||
         verb == Verb::compare_current || verb == Verb::compare_rise || verb == Verb::tune;
}

template <class Number>
std::optional<Number> number(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::string known_verbs() {
  std::string all;
  for (const std::string_view verb : plain_verb_names) {
    if (verb != name(Verb::none)) all += (all.empty() ? "" : ", ") + std::string(verb);
  }
  return all + ", clear, store tuning, clear tuning";
}

}  // namespace

tl::expected<Command, std::string> parse_command(std::string_view text, std::size_t channels) {
  const std::string_view channel_word = next_word(text);
  const auto channel = number<std::size_t>(channel_word);
  if (!channel || *channel < 1 || *channel > channels) {
    return tl::unexpected("channel '" + std::string(channel_word) + "': must be 1 to " +
                          std::to_string(channels));
  }
  const std::string_view verb_word = next_word(text);
  // To store nothing has a word of its own.
  const bool clears = verb_word == "clear";
  const auto found = std::find(plain_verb_names.begin(), plain_verb_names.end(),
                               clears ? name(Verb::store) : verb_word);
  const Verb verb = found == plain_verb_names.end()
                        ? Verb::none
                        : static_cast<Verb>(std::distance(plain_verb_names.begin(), found));
  if (verb == Verb::none) {
    return tl::unexpected("'" + std::string(verb_word) + "' is not a command; there are " +
                          known_verbs());
  }
  const bool stores = verb == Verb::store && !clears;
  Command command{static_cast<std::uint8_t>(*channel - 1), verb, stores ? 1.0 : 0.0};
  std::string_view value_word = next_word(text);
  if (verb == Verb::store && value_word == "tuning") {
    command.value = stores ? store_tuning : clear_tuning;
    value_word = next_word(text);
  }
  if (has_value(verb)) {
    const auto value = number<double>(value_word);
    if (!value || !std::isfinite(*value)) {
      return tl::unexpected("'" + std::string(value_word) + "': " + std::string(name(verb)) +
                            " needs a number");
    }
    command.value = *value;
  }
  const std::string_view rest = has_value(verb) ? next_word(text) : value_word;
  if (!rest.empty()) return tl::unexpected("'" + std::string(rest) + "' is too much");
  return command;
}

std::string answer_text(Refusal refusal, double nearest) {
  if (refusal == Refusal::none) return "ok";
  std::ostringstream text;
  text << "refused: " << name(refusal);
  if (!std::isnan(nearest)) text << "; " << nearest << " would be obeyed";
  return text.str();
}

}  // namespace supercoil
