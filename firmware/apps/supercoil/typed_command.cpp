#include "apps/supercoil/typed_command.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "can/nodes.hpp"
#include "loop/command.hpp"
#include "text/command_text.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace supercoil::operating {

namespace {

constexpr int position_digits = 9;  // in metres: nanometres
constexpr int limit_digits = 7;     // limits are floats on a bus
constexpr double deg_per_rad = 180.0 / std::numbers::pi;

struct Value {
  double number = 0.0;
  bool in_degrees = false;  ///< else in the unit of its command
};

/// Parses "0.02", "20deg" or "20°".
std::optional<Value> value_of(std::string_view text) {
  bool in_degrees = false;
  for (const std::string_view unit : {"deg", "°"}) {
    if (!text.ends_with(unit)) continue;
    in_degrees = true;
    text.remove_suffix(unit.size());
    break;
  }
  const auto number = typed_number(text);
  return number ? std::optional(Value{*number, in_degrees}) : std::nullopt;
}

/// The value of a command; only a position may be in degrees.
std::optional<Value> value_of(const std::vector<std::string>& words) {
  if (words.size() != 3) return std::nullopt;
  const auto value = value_of(words[2]);
  return value && value->in_degrees && words[1] != name(Verb::position) ? std::nullopt : value;
}

}  // namespace

std::string line_of(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : " ") + word;
  return line;
}

std::optional<double> typed_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool is_channel(std::string_view text) {
  const auto channel = typed_number(text);
  return channel && *channel >= 1.0 && *channel <= can::max_nodes &&
         *channel == std::floor(*channel);
}

std::string addressed(const CommandOptions& options) {
  return options.can.empty() ? "channel" : "node";
}

std::vector<std::string> split_words(const std::vector<std::string>& quoted) {
  std::vector<std::string> words;
  for (std::string_view rest : quoted) {
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
      words.emplace_back(word);
  }
  return words;
}

std::string first_word_problem(const CommandOptions& options) {
  if (options.words.empty())
    return "no command: it must be state, or a " + addressed(options) + " and a command";
  const std::string& first = options.words[0];
  if (first == "state" || typed_number(first)) return "";
  return "'" + first + "': must be state, or a " + addressed(options) + ", as in '1 arm'";
}

bool is_angle(const CommandOptions& options) {
  return value_of(options.words).value_or(Value{}).in_degrees;
}

double value_at(const CommandOptions& options, double sine) {
  const double amplitude = value_of(options.sine_amplitude).value_or(Value{}).number;
  const double value = value_of(options.words).value_or(Value{}).number + amplitude * sine;
  return is_angle(options) ? options.joint.position_m(value / deg_per_rad) : value;
}

std::string line_at(const CommandOptions& options, double time_s) {
  const bool has_sine = options.sine_period_s > 0.0;
  if (!has_sine && !is_angle(options)) return line_of(options.words);
  const double sine =
      has_sine ? std::sin(2.0 * std::numbers::pi * time_s / options.sine_period_s) : 0.0;
  return line_of(
      {options.words[0], options.words[1], number_text(value_at(options, sine), position_digits)});
}

std::string degrees_text(const CommandOptions& options, double position_m) {
  constexpr double per_deg = 1e4;
  const double angle_deg = deg_per_rad * options.joint.angle_rad(position_m);
  return number_text(std::trunc(per_deg * angle_deg) / per_deg, 7) + "deg";
}

std::string position_range(const CommandOptions& options, const KnownMuscle& known) {
  const double min_m = known[known_min_set_point];
  const double max_m = known[known_max_set_point];
  if (!(min_m < max_m)) return "";
  const auto shown = [&](double position_m) {
    return options.joint.direction == 0 ? number_text(position_m, limit_digits)
                                        : degrees_text(options, position_m);
  };
  // An antagonist's positions grow as the angle falls.
  const bool turned = options.joint.direction < 0;
  return "; " + shown(turned ? max_m : min_m) + " to " + shown(turned ? min_m : max_m) +
         " are in range";
}

std::string hold_problem(const CommandOptions& options) {
  constexpr std::array<Verb, 5> renewed{Verb::position, Verb::power, Verb::renew, Verb::identify,
                                        Verb::calibrate};
  const std::string& verb_word = options.words[options.words.size() > 1 ? 1 : 0];
  const bool is_known = verb_word == "state" || verb_word == "clear" ||
                        std::ranges::find(plain_verb_names, verb_word) != plain_verb_names.end();
  const bool is_renewed =
      std::ranges::any_of(renewed, [&](Verb verb) { return verb_word == name(verb); });
  // Whoever parses the line reports an unknown command.
  if (options.hold_s == 0.0 || !is_known || is_renewed) return "";
  std::string verbs;
  for (const Verb verb : renewed)
    verbs.append(verbs.empty() ? "" : verb == renewed.back() ? " and " : ", ").append(name(verb));
  return line_of(options.words) + (std::isinf(options.hold_s) ? " --hold" : " --for") +
         ": nothing to renew; it applies to " + verbs;
}

std::string sine_problem(const CommandOptions& options) {
  const auto middle = value_of(options.words);
  if (!middle) return line_of(options.words) + ": a sine needs a number as its middle";
  const auto amplitude = value_of(options.sine_amplitude);
  if (!amplitude) {
    return "--amplitude " + options.sine_amplitude + ": must be a number" +
           (middle->in_degrees ? " of degrees, such as 3deg" : "");
  }
  if (amplitude->in_degrees != middle->in_degrees) {
    return line_of(options.words) + " --amplitude " + options.sine_amplitude +
           ": both must have the same unit; for an angle both are in degrees, such as 5deg and "
           "3deg";
  }
  const bool of_power = options.words[1] == name(Verb::power);
  const double lowest = std::min(value_at(options, -1.0), value_at(options, 1.0));
  if (const std::string problem = of_power ? value_problem(Verb::power, lowest) : "";
      !problem.empty())
    return line_of(options.words) + " --amplitude " + options.sine_amplitude + ": " + problem;
  return options.hold_s > 0.0 ? "" : "a sine needs --for or --hold";
}

}  // namespace supercoil::operating
