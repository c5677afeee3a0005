// supercoil command: sends one command to a board, once or repeatedly.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <thread>

#include <nlohmann/json.hpp>

#include "apps/common/progress.hpp"
#include "apps/supercoil/board_link.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/interrupted.hpp"
#include "apps/supercoil/tuned_place.hpp"
#include "apps/supercoil/typed_command.hpp"
#include "apps/supercoil/value_range.hpp"
#include "text/command_text.hpp"
#include "text/refusal_words.hpp"
#include "text/result_words.hpp"

namespace supercoil::operating {

namespace {

using Clock = std::chrono::steady_clock;

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

std::string with_degrees(const CommandOptions& options, const std::string& answer) {
  const auto reply = parse_answer(answer);
  if (options.joint.direction == 0 || !reply || std::isnan(reply->nearest)) return answer;
  return answer + " (" + degrees_text(options, reply->nearest) + ")";
}

/// The range, after an out-of-range value. Empty: the board does not tell.
std::string range_of_refused(BoardLink& board, const CommandOptions& options,
                             const std::string& answer) {
  if (options.words.size() != 3 || !refuses(answer, Refusal::out_of_range)) return "";
  for (const Verb verb : {Verb::scale, Verb::controller, Verb::estimator}) {
    if (options.words[1] == name(verb)) return accepted_range_text(board, options.words[0], verb);
  }
  if (options.words[1] != name(Verb::position)) return "";
  const auto known = board.muscle(options.words[0]);
  return known ? position_range(options, *known) : "";
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

/// Also names the range of a refused value.
int report_with_range(BoardLink& board, const CommandOptions& options, const std::string& line,
                      const BoardLink::Answer& answer) {
  const std::string range = answer ? range_of_refused(board, options, *answer) : "";
  return report_answer(options, line, answer, range);
}

int send_line(BoardLink& board, const CommandOptions& options, const std::string& line) {
  return report_with_range(board, options, line, board.ask(line));
}

/// Reports a wrong request, or one without an answer; as JSON too if wanted.
int refused(const CommandOptions& options, int status, const std::string& why) {
  if (options.json) {
    const nlohmann::ordered_json report{{"command", line_of(options.words)}, {"error", why}};
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
  const std::string remedy = result == "interrupted" ? "" : result_remedy();
  if (result != "found") return fail(exit_failed, all + remedy);
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
  Progress progress(line_of(options.words), false);
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
    // What was obeyed before must not end in the fault command_timeout.
    if (!goes_on && !is_over && !first) static_cast<void>(board.ask(options.words[0] + " rest"));
    if (is_over && !first && !resends_value) return report_endings(board, options);
    if (is_over) return report_stopped(board, options, line, *answer);
    if (!goes_on) return report_with_range(board, options, line, answer);
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
  // Whoever parses the line reports a wrong channel.
  if (!is_angle(options) || !is_channel(options.words[0])) return exit_done;
  const auto muscle = board.muscle(options.words[0]);
  if (!muscle) {
    return refused(options, exit_for(muscle.error()),
                   line_of(options.words) + ": " + muscle.error().text());
  }
  options.joint = joint_from(*muscle);
  if (options.joint.direction == 0) {
    return refused(options, exit_wrong_input,
                   line_of(options.words) + ": " + addressed(options) + " " + options.words[0] +
                       " is in no joint: its position is in metres");
  }
  return exit_done;
}

/// A sine of positions that leaves the board's range would be refused on its way. Returns an exit
/// status.
int check_sine_range(BoardLink& board, const CommandOptions& options) {
  if (options.sine_period_s == 0.0 || options.words[1] != name(Verb::position)) return exit_done;
  // Whoever parses the line reports a wrong channel.
  if (!is_channel(options.words[0])) return exit_done;
  const auto known = board.muscle(options.words[0]);
  if (!known) return exit_done;
  const double min_m = (*known)[known_min_set_point];
  const double max_m = (*known)[known_max_set_point];
  if (!(min_m < max_m)) return exit_done;
  const auto [lowest_m, highest_m] = std::minmax({value_at(options, -1.0), value_at(options, 1.0)});
  if (lowest_m >= float_rounding * min_m && highest_m <= float_rounding * max_m) return exit_done;
  return refused(options, exit_failed,
                 line_of(options.words) + " --amplitude " + options.sine_amplitude +
                     ": leaves the range" + position_range(options, *known));
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
  // Whoever parses the line reports a wrong channel.
  if (!is_channel(words[0])) return exit_done;
  if (!tunes && (!chooses || typed_number(words[2]))) return exit_done;
  const ReadTunable read_value = tunable_reader(board, words[0]);
  const Tuned what = chooses_controller ? Tuned::controller : Tuned::estimator;
  const auto place =
      tunes ? find_any_place(words[2], read_value) : find_place(what, words[2], read_value);
  if (!place) {
    return refused(options, exit_for(place.error()), line_of(words) + ": " + place.error().text());
  }
  words[2] = std::to_string(*place);
  return exit_done;
}

}  // namespace

int command_command(CommandOptions options) {
  options.words = split_words(options.words);
  if (const std::string problem = first_word_problem(options); !problem.empty())
    return refused(options, exit_wrong_input, problem);
  if (options.words[0] == "state" && options.words.size() > 1) {
    return refused(options, exit_wrong_input,
                   line_of(options.words) + ": state covers all channels: leave out '" +
                       options.words[1] + "'");
  }
  if (const std::string problem = hold_problem(options); !problem.empty())
    return refused(options, exit_wrong_input, problem);
  if (options.sine_period_s > 0.0) {
    if (const std::string problem = sine_problem(options); !problem.empty())
      return refused(options, exit_wrong_input, problem);
  }
  const auto board = open_link(options.can, options.socket);
  if (!board) return refused(options, exit_failed, board.error().text());
  if (const int status = read_joint(**board, options); status != exit_done) return status;
  if (const int status = resolve_place(**board, options); status != exit_done) return status;
  if (const int status = check_sine_range(**board, options); status != exit_done) return status;
  options.hold_s = held_s(options);
  const std::string line = line_at(options, 0.0);
  if (line == "state") return print_state(**board, options);
  if (options.hold_s > 0.0) return hold(**board, options);
  const bool arms = options.words.size() == 2 && options.words[1] == name(Verb::arm);
  return arms ? report_answer(options, line, arm(**board, options.words[0]))
              : send_line(**board, options, line);
}

}  // namespace supercoil::operating
