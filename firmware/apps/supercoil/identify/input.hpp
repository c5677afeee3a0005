// Reads a recording from a file of any supported kind.
#pragma once

#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/identification/recording.hpp"

#include "apps/supercoil/identify/options.hpp"

namespace supercoil::operating {

/// Reads CSV or a flight recording, checks it, and cuts it as the options say. The error names the
/// file, and the line if there is one.
Result<identification::Recording> read_input(const IdentifyOptions& options);

/// "FILE:LINE: what is wrong"
std::string to_text(const std::string& file, const identification::Problem& problem);

}  // namespace supercoil::operating
