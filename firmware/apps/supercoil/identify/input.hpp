// A recording from a file, whatever kind of file it is.
#pragma once

#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/identification/recording.hpp"

#include "apps/supercoil/identify/options.hpp"

namespace supercoil::operating {

/// CSV or a flight recording, checked and cut as the options say. The error has the file's name,
/// and the line where there is one.
Result<identification::Recording> read_input(const IdentifyOptions& options);

/// "FILE:LINE: what is wrong"
std::string to_text(const std::string& file, const identification::Problem& problem);

}  // namespace supercoil::operating
