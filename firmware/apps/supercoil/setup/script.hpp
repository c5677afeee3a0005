// What a person would answer, in a file.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "apps/supercoil/setup/muscle_answers.hpp"
#include "apps/supercoil/setup/nameplate.hpp"

namespace supercoil::operating {

struct Script {
  Nameplate nameplate;
  MuscleAnswers muscle;  ///< a key that is not there is not answered
  double take_gains = operating::take_gains.fallback;
};
/// The tables [muscle] and [nameplate] of a file, the second of which may be absent. The error is
/// whole lines.
tl::expected<Script, std::string> read_script(const std::string& path);

}  // namespace supercoil::operating
