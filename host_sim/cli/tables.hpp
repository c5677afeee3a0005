// The results of a comparison: its files, and its tables on the terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

struct Tables {
  std::vector<std::pair<std::string, std::string>> files;  ///< name, content
  std::string markdown;                                    ///< for the terminal
  std::size_t runs = 0;
  nlohmann::ordered_json rows;  ///< for programs
};

/// How the results are printed.
struct TableOutput {
  bool json;   ///< the rows, instead of the tables
  bool quiet;  ///< no tables
};

/// Writes the files, commits the folder and prints the results. Returns the program's exit status.
int conclude_tables(const Tables& tables, OutputFolder& folder, TableOutput output);

}  // namespace supercoil::host_sim
