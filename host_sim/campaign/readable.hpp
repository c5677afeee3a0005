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

/// The run's fault and the goals that it missed, with its values.
std::string missed(const Study& study, const Outcome& outcome);

/// Draws that the goal's quantity follows more than by chance, strongest first.
std::vector<std::size_t> deciding_draws(const GoalRow& row);

/// The draws that the quantity follows most, with their signs: no more than three.
std::string deciding(const Study& study, const GoalRow& row);

/// "log-uniform, 8 to 80, times A, divided by B".
std::string described(const Draw& draw);

/// The text as one word for a shell, whatever it contains.
std::string shell_word(const std::string& text);

}  // namespace supercoil::host_sim::campaign
