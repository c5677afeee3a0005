// supercoil command: sends one command to a board, once or repeatedly.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string_view>
#include <thread>

#include <nlohmann/json.hpp>

#include "apps/common/progress.hpp"
#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/tuned_place.hpp"
#include "apps/supercoil/value_range.hpp"
#include "telemetry/frames.hpp"
#include "text/command_text.hpp"
#include "text/number_text.hpp"
#include "text/refusal_words.hpp"
#include "text/result_words.hpp"

namespace supercoil::operating {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int digits = 9;  // of a position in metres: nanometres
constexpr double deg_per_rad = 180.0 / std::numbers::pi;

/// Otherwise the line was wrong and reached no channel.
bool is_answer(std::string_view answer) {
  return answer == "ok" || answer.starts_with("refused") || answer.starts_with("fault");
}

/// A board's answer as an exit status; prints anything but "ok".
int exit_status_of(const std::string& line, const std::string& answer) {
  if (answer == "ok") return exit_done;
  return fail(is_answer(answer) ? exit_failed : exit_wrong_input,
              line + ": " + answer_with_reason(line, answer));
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The nearest position that would be obeyed, for a request in degrees: rounded towards 0, so that
/// it is obeyed.
std::string degrees_text(const CommandOptions& options, double position_m) {
  constexpr double per_deg = 1e4;
  const double angle_deg = deg_per_rad * options.joint.angle_rad(position_m);
  return number_text(std::trunc(per_deg * angle_deg) / per_deg, 7) + "deg";
}

std::string with_degrees(const CommandOptions& options, const std::string& answer) {
  const auto reply = parse_answer(answer);
  if (options.joint.direction == 0 || !reply || std::isnan(reply->nearest)) return answer;
  return answer + " (" + degrees_text(options, reply->nearest) + ")";
}

/// The range, after an out-of-range value: "; -0.025 to 0.025 are in range". Empty: the board does
/// not tell.
std::string range_of_refused(BoardLink& board, const CommandOptions& options,
                             const std::string& answer) {
  if (options.words.size() != 3 || !refuses(answer, Refusal::out_of_range)) return "";
  for (const Verb verb : {Verb::scale, Verb::controller, Verb::estimator}) {
    if (options.words[1] == name(verb)) return accepted_range_text(board, options.words[0], verb);
  }
  if (options.words[1] != name(Verb::position)) return "";
  const auto known = board.muscle(options.words[0]);
  if (!known) return "";
  const double min_m = (*known)[known_min_set_point];
  const double max_m = (*known)[known_max_set_point];
  if (!(min_m < max_m)) return "";
  const auto shown = [&](double position_m) {
    return options.joint.direction == 0 ? number_text(position_m, digits)
                                        : degrees_text(options, position_m);
  };
  // An antagonist's positions grow as the angle falls.
  const bool turned = options.joint.direction < 0;
  return "; " + shown(turned ? max_m : min_m) + " to " + shown(turned ? min_m : max_m) +
         " are in range";
}

/// Reports a command's result, as text or as JSON on standard output.
int report_answer(const CommandOptions& options, const std::string& line,
                  const BoardLink::Answer& answer, const std::string& range = "") {
  if (options.json) {
    nlohmann::ordered_json report{{"command", line}};
    report[answer && is_answer(*answer) ? "answer" : "error"] =
        answer ? *answer : answer.error().text();
    if (!range.empty()) report["range"] = range.substr(range.find_first_not_of("; "));
    std::printf("%s\n", report.dump().c_str());
  }
  return answer ? exit_status_of(line, with_degrees(options, *answer) + range)
                : fail(exit_failed, answer.error().text());
}

/// A held command was refused: its channel may not heat, or no longer may. Tells by which fault.
int report_stopped(BoardLink& board, const CommandOptions& options, const std::string& line,
                   const std::string& answer) {
  std::string fault = present_fault(board, options.words[0]);
  // The known state of the board may be slightly older than its refusal.
  for (int i = 0; fault.empty() && i < 5; ++i) {
    board.wait(std::chrono::milliseconds(100));
    fault = present_fault(board, options.words[0]);
  }
  if (fault.empty()) return report_answer(options, line, answer);
  if (options.json) {
    const nlohmann::ordered_json report{{"command", line}, {"answer", answer}, {"cause", fault}};
    std::printf("%s\n", report.dump().c_str());
  }
  return fail(exit_failed, line + ": " + fault);
}

int send_line(BoardLink& board, const CommandOptions& options, const std::string& line) {
  const auto answer = board.ask(line);
  const std::string range = answer ? range_of_refused(board, options, *answer) : "";
  return report_answer(options, line, answer, range);
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : " ") + word;
  return line;
}

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
  const auto number = number_of(text);
  return number ? std::optional(Value{*number, in_degrees}) : std::nullopt;
}

/// The value of a command; only a position may be in degrees.
std::optional<Value> value_of(const std::vector<std::string>& words) {
  if (words.size() != 3) return std::nullopt;
  const auto value = value_of(words[2]);
  return value && value->in_degrees && words[1] != name(Verb::position) ? std::nullopt : value;
}

bool is_angle(const CommandOptions& options) {
  return value_of(options.words).value_or(Value{}).in_degrees;
}

/// The line for the board: channel and verb unchanged; the value on the sine, if there is one, and
/// in metres.
std::string line_at(const CommandOptions& options, double time_s) {
  const bool has_sine = options.sine_period_s > 0.0;
  if (!has_sine && !is_angle(options)) return joined(options.words);
  double value = value_of(options.words).value_or(Value{}).number;
  if (has_sine) {
    const double amplitude = value_of(options.sine_amplitude).value_or(Value{}).number;
    value += amplitude * std::sin(2.0 * std::numbers::pi * time_s / options.sine_period_s);
  }
  if (is_angle(options)) value = options.joint.position_m(value / deg_per_rad);
  return joined({options.words[0], options.words[1], number_text(value, digits)});
}

/// Reports a wrong request, or one without an answer; as JSON too if wanted.
int refused(const CommandOptions& options, int status, const std::string& why) {
  if (options.json) {
    const nlohmann::ordered_json report{{"command", joined(options.words)}, {"error", why}};
    std::printf("%s\n", report.dump().c_str());
  }
  return fail(status, why);
}

/// identify and calibrate end by themselves, with a result.
bool has_result(const CommandOptions& options) {
  if (options.words.size() < 2) return false;
  return options.words[1] == name(Verb::identify) || options.words[1] == name(Verb::calibrate);
}

/// Sent once, identify and calibrate would end with the fault command_timeout: they are held.
double held_s(const CommandOptions& options) {
  const bool until_it_ends = options.words.size() == 2 && has_result(options);
  return options.hold_s == 0.0 && until_it_ends ? INFINITY : options.hold_s;
}

/// Reports one channel's end, as text or JSON. own: how this program ended it; empty: it did not.
int report_ending(BoardLink& board, const CommandOptions& options, const ChannelEnding& of,
                  const std::string& own) {
  const auto& [result, notes] = of.ending;
  const std::string line = of.channel + " " + options.words[1];
  std::string cause;
  if (result == "interrupted")
    cause = own.empty() ? interruption(board, of.channel).value_or("") : own;
  if (options.json) {
    nlohmann::ordered_json json{{"command", line}, {"result", result}};
    if (!notes.empty()) json["notes"] = notes;
    if (!cause.empty()) json["cause"] = cause;
    std::printf("%s\n", json.dump().c_str());
  }
  const std::string all = line + " ended: " + result_text(result, notes, cause);
  const bool has_remedy = result != "interrupted";
  if (result != "found")
    return fail(exit_failed, all + (has_remedy ? "; docs/troubleshooting.md says what to do" : ""));
  if (!notes.empty() && !options.json) std::printf("%s\n", all.c_str());
  return exit_done;
}

/// Reports the result of an ended mode, if it has one. own: as in report_ending().
int report_endings(BoardLink& board, const CommandOptions& options, const std::string& own = "") {
  if (!has_result(options)) return exit_done;
  const auto all = endings(board, options.words[0]);
  if (!all) return refused(options, exit_failed, all.error().text());
  int status = exit_done;
  for (const ChannelEnding& each : *all)
    status = std::max(status, report_ending(board, options, each, own));
  return status;
}

/// Progress: the board's for a mode that ends by itself, otherwise that of the time.
double progress_ratio(BoardLink& board, const CommandOptions& options, double time_s) {
  if (has_result(options)) return board.progress(options.words[0]).value_or(NAN);
  return std::isfinite(options.hold_s) ? time_s / options.hold_s : NAN;
}

/// Holds a command until its time is over or it is interrupted; then the muscle rests.
int hold(BoardLink& board, const CommandOptions& options) {
  watch_for_interrupts();
  const bool resends_value = options.words.size() == 3;
  Progress progress(joined(options.words), false);
  // The first call takes a moment, in which a command to heat would expire.
  if (progress.shows()) progress_ratio(board, options, 0.0);
  const auto begin = Clock::now();
  auto next = begin;
  for (;;) {
    const double time_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const bool first = next == begin;
    const std::string line =
        first || resends_value ? line_at(options, time_s) : options.words[0] + " renew";
    const auto answer = board.ask(line);
    const bool is_over = answer && refuses(*answer, Refusal::wrong_state);
    const bool goes_on = answer && *answer == "ok";
    if (!goes_on) progress.end();
    if (is_over && !first && !resends_value) return report_endings(board, options);
    if (is_over) return report_stopped(board, options, line, *answer);
    if (!goes_on) return report_answer(options, line, answer);
    if (progress.shows()) progress.show(progress_ratio(board, options, time_s), "");
    if (interrupted != 0 || time_s >= options.hold_s) break;
    next += std::chrono::milliseconds(options.sine_period_s > 0.0 ? 20 : 50);
    std::this_thread::sleep_until(next);
  }
  progress.end();
  const std::string rest = options.words[0] + " rest";
  if (!has_result(options)) return send_line(board, options, rest);
  const auto answer = board.ask(rest);
  const std::string own =
      std::string("by ") + (interrupted != 0 ? interrupter() : "the end of --for");
  return answer ? report_endings(board, options, own) : report_answer(options, rest, answer);
}

int print_state(BoardLink& board, const CommandOptions& options) {
  const auto answer = options.json ? board.state_json() : board.state();
  if (!answer) return refused(options, exit_failed, answer.error().text());
  std::fputs(answer->c_str(), stdout);
  return exit_done;
}

/// For a position in degrees: reads the joint, which its channel must be in. Returns an exit
/// status.
int read_joint(BoardLink& board, CommandOptions& options) {
  if (!is_angle(options)) return exit_done;
  const auto muscle = board.muscle(options.words[0]);
  if (!muscle) return refused(options, exit_failed, muscle.error().text());
  options.joint = joint_from(*muscle);
  if (options.joint.direction == 0) {
    return refused(options, exit_wrong_input,
                   joined(options.words) + ": channel " + options.words[0] +
                       " is in no joint: its position is in metres");
  }
  return exit_done;
}

/// What is wrong with a sine; empty: nothing.
std::string sine_problem(const CommandOptions& options) {
  const auto middle = value_of(options.words);
  if (!middle) return joined(options.words) + ": a sine needs a number as its middle";
  const auto amplitude = value_of(options.sine_amplitude);
  if (!amplitude) {
    return "--amplitude " + options.sine_amplitude + ": must be a number" +
           (middle->in_degrees ? " of degrees, such as 3deg" : "");
  }
  if (amplitude->in_degrees != middle->in_degrees) {
    return joined(options.words) + " --amplitude " + options.sine_amplitude +
           ": both must have the same unit; for an angle both are in degrees, such as 5deg and "
           "3deg";
  }
  return options.hold_s > 0.0 ? "" : "a sine needs --for or --hold";
}

/// Replaces the kind of a controller or an estimator by its place. The board refuses wrong numbers
/// itself, except for `tune`, where its nearest value would be that of the wire. Returns an exit
/// status.
int resolve_place(BoardLink& board, CommandOptions& options) {
  auto& words = options.words;
  if (words.size() != 3) return exit_done;
  const bool tunes = words[1] == name(Verb::tune);
  const bool chooses_controller = words[1] == name(Verb::controller);
  const bool chooses = chooses_controller || words[1] == name(Verb::estimator);
  const auto channel = number_of(words[0]);
  // Whoever parses the line reports a wrong channel.
  if (!channel || !(*channel >= 1.0 && *channel <= can::max_nodes)) return exit_done;
  if (!tunes && (!chooses || number_of(words[2]))) return exit_done;
  const ReadTunable read_value = tunable_reader(board, words[0]);
  const Tuned what = chooses_controller ? Tuned::controller : Tuned::estimator;
  const auto place =
      tunes ? find_any_place(words[2], read_value) : find_place(what, words[2], read_value);
  if (!place) {
    return refused(options, exit_for(place.error()), joined(words) + ": " + place.error().text());
  }
  words[2] = std::to_string(*place);
  return exit_done;
}

}  // namespace

int command_command(CommandOptions options) {
  if (options.words[0] == "state" && options.words.size() > 1) {
    return refused(options, exit_wrong_input,
                   joined(options.words) + ": state covers all channels: leave out '" +
                       options.words[1] + "'");
  }
  if (options.sine_period_s > 0.0) {
    if (const std::string problem = sine_problem(options); !problem.empty())
      return refused(options, exit_wrong_input, problem);
  }
  const auto board = open_link(options.can, options.socket);
  if (!board) return refused(options, exit_failed, board.error().text());
  if (const int status = read_joint(**board, options); status != exit_done) return status;
  if (const int status = resolve_place(**board, options); status != exit_done) return status;
  options.hold_s = held_s(options);
  const std::string line = line_at(options, 0.0);
  if (line == "state") return print_state(**board, options);
  if (options.hold_s > 0.0) return hold(**board, options);
  const bool arms = options.words.size() == 2 && options.words[1] == name(Verb::arm);
  return arms ? report_answer(options, line, arm(**board, options.words[0]))
              : send_line(**board, options, line);
}

}  // namespace supercoil::operating
