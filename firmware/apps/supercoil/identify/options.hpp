// Options of supercoil identify.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "supercoil/identification/recording.hpp"

namespace CLI {
class App;
}

namespace supercoil::operating {

struct IdentifyOptions {
  std::string file;
  identification::Columns columns;
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();
  std::string fit;    ///< "FROM:TO"; empty: the default part
  std::string judge;  ///< likewise
  bool bridge_gaps = false;
  std::optional<double> thermal_mass_J_per_K;
  std::optional<double> stiffness_N_per_m;
  std::optional<double> moving_mass_kg;
  std::string muscle;  ///< file for the [muscle] table; empty: standard output
  std::string plot;    ///< empty: none
  bool json = false;
};
void add_identify(CLI::App& app, IdentifyOptions& options);
/// Returns the program's exit status.
int identify_command(const IdentifyOptions& options);

}  // namespace supercoil::operating
