// A campaign's figures as a person reads them, the same in every report.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "campaign/tables.hpp"

namespace supercoil::host_sim::campaign {

/// Three digits.
std::string brief(double value);

/// A value of the goal's quantity, with its unit.
std::string shown(const Goal& goal, double value);

/// The share and its interval.
std::string percent(const Rate& rate);

/// The fault and the goals that a run missed, with what it came to.
std::string missed(const Study& study, const Outcome& outcome);

/// Draws that the goal's quantity follows more than by chance, those that it follows most first.
std::vector<std::size_t> deciding_draws(const GoalRow& row);

/// What the quantity follows most, with the sign of it: no more than three.
std::string deciding(const Study& study, const GoalRow& row);

/// "log-uniform, 8 to 80, times A, divided by B".
std::string described(const Draw& draw);

/// One word for a shell, whatever is in it.
std::string shell_word(const std::string& text);

}  // namespace supercoil::host_sim::campaign
