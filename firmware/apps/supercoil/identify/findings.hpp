// The findings of identify in a recording, and their reports.
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
  bool stiffness_assumed = true;  ///< neither stiffness nor mass was given
  bool thermal_mass_assumed = true;
};

/// As text for a terminal.
std::string report(const Findings& findings);
/// The same as JSON, ending with a newline.
std::string json_report(const Findings& findings);
/// The [muscle] table as scenarios and board configurations read it; comments mark assumed values.
/// The error names a value that no muscle can have.
Result<std::string> muscle_table(const Findings& findings);
/// Measured and predicted position, residual, and power.
Figure identify_figure(const Findings& findings);

/// Whether the recording constrains a parameter more tightly than what was assumed before.
bool is_determined(const identification::Fit& fit, std::size_t parameter);

}  // namespace supercoil::operating
