// The results of a comparison: its files and its table.
#pragma once

#include "cli/commands.hpp"
#include "compare/result.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

/// Writes all files, and prints the table. Returns the program's exit status, as the others do.
int conclude_comparison(const compare::Results& results, OutputFolder& folder,
                        const CompareOptions& options);

/// The same from the runs.csv of several parts.
int merge_comparisons(const CompareOptions& options);

/// Lists what there is to compare.
int list_compared(bool json);

}  // namespace supercoil::host_sim
