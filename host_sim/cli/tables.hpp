// What a comparison leaves: its files, and its tables on the terminal.
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

/// How it is told.
struct Telling {
  bool json;   ///< the rows, in place of the tables
  bool quiet;  ///< no tables
};

/// Writes the files, commits the folder, tells. Returns the program's exit status, as the commands
/// do.
int conclude_tables(const Tables& tables, OutputFolder& folder, Telling telling);

}  // namespace supercoil::host_sim
