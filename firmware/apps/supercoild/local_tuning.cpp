#include "apps/supercoild/local_tuning.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "text/command_text.hpp"
#include "text/words.hpp"

namespace supercoil::daemon {

namespace {

std::optional<double> number(std::string_view word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<TuningSet> set_named(std::string_view word) {
  const auto found = std::ranges::find(tuning_set_names, word);
  if (found == tuning_set_names.end()) return std::nullopt;
  return static_cast<TuningSet>(found - tuning_set_names.begin());
}

std::string wrong_text(std::string_view word, std::string_view what) {
  return "wrong: '" + std::string(word) + "' is not a " + std::string(what);
}

std::string prepare_value(Tuner& tuner, std::size_t place, std::string_view name,
                          std::string_view value) {
  if (name == "all") {
    const auto set = set_named(value);
    if (!set) return wrong_text(value, "set of values");
    return answer_text(tuner.prepare_from(*set, place) ? Refusal::none : Refusal::out_of_range,
                       NAN);
  }
  const auto wanted = number(value);
  if (!wanted) return wrong_text(value, "number");
  const Reply reply = tuner.prepare(place, control::tunable_named(name), *wanted);
  return answer_text(reply.refusal, reply.nearest);
}

}  // namespace

std::optional<std::string> answer_tuning_request(std::string_view text, Loop& loop) {
  const std::string_view request = next_word(text);
  if (request != "tuning" && request != "prepare") return std::nullopt;
  const std::string_view channel_word = next_word(text);
  const std::string_view place_word = next_word(text);
  const std::string_view name = next_word(text);
  const std::string_view last = next_word(text);
  const auto channel = parse_channel(channel_word, loop.channels());
  if (!channel) return "wrong: " + channel.error().text();
  const auto place = number(place_word);
  if (!place || !(*place >= 0.0 && *place <= 255.0)) return wrong_text(place_word, "controller");
  Tuner& tuner = loop.channel(*channel).tuner();
  const auto at = static_cast<std::size_t>(*place);
  if (request == "prepare") return prepare_value(tuner, at, name, last);
  const auto set = set_named(last);
  if (!set) return wrong_text(last, "set of values");
  std::ostringstream value_text;
  value_text.precision(17);
  value_text << tuner.value(*set, at, control::tunable_named(name));
  return value_text.str();
}

}  // namespace supercoil::daemon
