// Muscles that nothing was tuned on, and what a person with a ruler would say of each.
#pragma once

#include <string>
#include <vector>

#include "apps/supercoil/setup/describe_muscle.hpp"
#include "apps/supercoil/setup/muscle_answers.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::test {

struct HeldOut {
  std::string scenario;  ///< TOML: the muscle, and a supply that its power needs
  operating::MuscleAnswers answers;
  std::vector<operating::Entry> board;  ///< what its board's file has otherwise
  double time_constant_s = 0.0;
  bool linear = true;
};

/// Parameters over about a decade each; every second muscle has a random part of the effects of
/// muscles as they are (docs/muscles.md). Answers are wrong by a random factor of 1 ± error, but
/// for resistance, power and travel, which are read from instruments or chosen.
HeldOut held_out_muscle(unsigned seed, double error, double slower = 1.0);

/// A board at 1 kHz with one channel, which the answers have not been put into yet.
std::string held_out_board(double cold_resistance_Ohm, double max_W);

}  // namespace supercoil::test
