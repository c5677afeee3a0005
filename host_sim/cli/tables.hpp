// What a comparison leaves: its files, and its tables on the terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

struct Tables {
  std::vector<std::pair<std::string, std::string>> files;  ///< name, content
  std::string markdown;                                    ///< for the terminal
  std::size_t runs = 0;
};

/// Writes the files, commits the folder, prints the tables unless quiet. Returns the program's exit
/// status, as the commands do.
int conclude_tables(const Tables& tables, OutputFolder& folder, bool quiet);

}  // namespace supercoil::host_sim
