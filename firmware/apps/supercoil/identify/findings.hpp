// What identify found in a recording, and how it is told.
#pragma once

#include <string>

#include "supercoil/identification/comparison.hpp"
#include "supercoil/identification/physical.hpp"

#include "plot/figure.hpp"

namespace supercoil::operating {

struct Findings {
  std::string file;
  std::size_t rows = 0;
  identification::Samples samples;
  identification::Comparison comparison;
  identification::Fit whole;         ///< the chosen model, fitted to the whole recording
  identification::Fit linear_first;  ///< its linear part, fitted to the fitted part
  identification::Fit linear;        ///< and to the whole recording
  identification::Assumed assumed;
  bool stiffness_assumed = true;  ///< nobody said it, nor the mass
  bool thermal_mass_assumed = true;
};

/// For a person at a terminal.
std::string report(const Findings& findings);
/// The same as JSON, with a line end.
std::string json_report(const Findings& findings);
/// [muscle] as a scenario and a board's configuration read it, with what is assumed in comments.
/// The error says which value no muscle has.
Result<std::string> muscle_table(const Findings& findings);
/// Measured and predicted position, what is left, and power.
Figure identify_figure(const Findings& findings);

/// Whether the recording says more of a parameter than was assumed before.
bool told(const identification::Fit& fit, std::size_t parameter);

}  // namespace supercoil::operating
