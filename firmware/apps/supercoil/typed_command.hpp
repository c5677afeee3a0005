// A command as it was typed: its words, and its value, which may be in degrees and on a sine.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/supercoil/commands.hpp"
#include "loop/known_muscle.hpp"

namespace supercoil::operating {

/// One quoted word may be a whole line.
std::vector<std::string> split_words(const std::vector<std::string>& quoted);
std::string line_of(const std::vector<std::string>& words);

/// What the first number of a line is: "channel", or "node" on a bus.
std::string addressed(const CommandOptions& options);

/// Empty: it is not a finite number.
std::optional<double> typed_number(std::string_view text);
bool is_channel(std::string_view text);
bool is_angle(const CommandOptions& options);

/// What is wrong with the first word; empty: nothing.
std::string first_word_problem(const CommandOptions& options);
/// Why a command cannot be renewed, if that is wanted; empty: it can.
std::string hold_problem(const CommandOptions& options);
/// What is wrong with a sine; empty: nothing.
std::string sine_problem(const CommandOptions& options);

/// The value at a sine, -1 to 1, of the amplitude; in metres if it is an angle.
double value_at(const CommandOptions& options, double sine);
/// The line for the board: channel and verb unchanged; the value on the sine, if there is one, and
/// in metres.
std::string line_at(const CommandOptions& options, double time_s);

/// The nearest position that would be obeyed, for a request in degrees: rounded towards 0, so that
/// it is obeyed.
std::string degrees_text(const CommandOptions& options, double position_m);
/// "; -0.025 to 0.025 are in range", in the unit of the request. Empty: the range is not known.
std::string position_range(const CommandOptions& options, const KnownMuscle& known);

}  // namespace supercoil::operating
