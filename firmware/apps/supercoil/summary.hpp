// What happened, in words or for programs.
#pragma once

#include <string>

#include "recorder/recording.hpp"

namespace supercoil::operating {

/// Lines for an operator: which fault, when and where, what followed, what each channel did and how
/// near each detector of the channel with the fault was. The recording must have a row.
std::string summary(const recorder::Recording& recording);

/// The same as an object: docs/json.md.
std::string summary_json(const recorder::Recording& recording);

}  // namespace supercoil::operating
