// Muscles that nothing was tuned on, and what a person with a ruler would say about each.
#pragma once

#include <string>
#include <vector>

#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/muscle_answers.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::test {

struct HeldOut {
  std::string scenario;  ///< TOML: the muscle, and the supply that its power needs
  operating::MuscleAnswers answers;
  std::vector<operating::Entry> board;  ///< what differs in its board's file
  double time_constant_s = 0.0;
  bool linear = true;
};

/// Parameters over about a decade each; every second muscle has a random part of the effects of
/// real muscles (docs/muscles.md). Answers are wrong by a random factor of 1 ± error, except
/// resistance, power and travel, which are read from instruments or chosen.
HeldOut held_out_muscle(unsigned seed, double error, double slower = 1.0);

/// A board at 1 kHz with one channel, before the answers are put into it.
std::string held_out_board(double cold_resistance_Ohm, double max_W);

}  // namespace supercoil::test
