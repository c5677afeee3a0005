#include "daemon/command_text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace supercoil::daemon {

namespace {

struct VerbName {
  std::string_view name;
  Verb verb;
  bool has_value;
};
constexpr std::array<VerbName, 12> verbs{{{"arm", Verb::arm, false},
                                          {"disarm", Verb::disarm, false},
                                          {"reset", Verb::reset, false},
                                          {"position", Verb::position, true},
                                          {"power", Verb::power, true},
                                          {"renew", Verb::renew, false},
                                          {"rest", Verb::rest, false},
                                          {"identify", Verb::identify, false},
                                          {"calibrate", Verb::calibrate, false},
                                          {"scale", Verb::scale, true},
                                          {"controller", Verb::controller, true},
                                          {"estimator", Verb::estimator, true}}};

constexpr std::array<std::string_view, 8> refusals{
    "none",      "wrong_state", "cause_persists", "no_edge",
    "not_ready", "busy",        "out_of_range",   "no_such_channel"};

/// The next word, cut off from the text.
std::string_view next_word(std::string_view& text) {
  const std::size_t from = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::size_t to = std::min(text.find_first_of(" \t\r\n", from), text.size());
  const std::string_view word = text.substr(from, to - from);
  text.remove_prefix(to);
  return word;
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
  for (const VerbName& verb : verbs)
    all += (all.empty() ? "" : ", ") + std::string(verb.name);
  return all;
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
  const VerbName* verb = nullptr;
  for (const VerbName& candidate : verbs) {
    if (candidate.name == verb_word) verb = &candidate;
  }
  if (verb == nullptr) {
    return tl::unexpected("'" + std::string(verb_word) + "' is not a command; there are " +
                          known_verbs());
  }
  Command command{static_cast<std::uint8_t>(*channel - 1), verb->verb, 0.0};
  const std::string_view value_word = next_word(text);
  if (verb->has_value) {
    const auto value = number<double>(value_word);
    if (!value || !std::isfinite(*value)) {
      return tl::unexpected("'" + std::string(value_word) + "': " + std::string(verb->name) +
                            " needs a number");
    }
    command.value = *value;
  }
  const std::string_view rest = verb->has_value ? next_word(text) : value_word;
  if (!rest.empty()) return tl::unexpected("'" + std::string(rest) + "' is too much");
  return command;
}

std::string answer_text(Refusal refusal) {
  if (refusal == Refusal::none) return "ok";
  return "refused: " + std::string(refusals[static_cast<std::size_t>(refusal)]);
}

}  // namespace supercoil::daemon
