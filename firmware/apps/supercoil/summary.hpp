// A summary of what happened, as text or JSON.
#pragma once

#include <string>

#include "recorder/recording.hpp"

namespace supercoil::operating {

/// Lines for an operator: which fault, when and where, what followed, what each channel did, and
/// how near to tripping each detector of the faulted channel was. The recording must have a row.
std::string summary(const recorder::Recording& recording);

/// The same as an object: docs/json.md.
std::string summary_json(const recorder::Recording& recording);

}  // namespace supercoil::operating
