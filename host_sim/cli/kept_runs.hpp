// A comparison that keeps its runs as they end and can be resumed after an interruption.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "apps/common/progress.hpp"
#include "cli/commands.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

inline constexpr const char* runs_name = "runs.csv";

class KeptRuns {
 public:
  /// all: runs that this command asks for; todo: those of them that are not kept yet. before: runs
  /// that are kept, also of other commands. torn: the file's last line is incomplete.
  struct Count {
    std::size_t before;
    std::size_t all;
    std::size_t todo;
    bool torn;
  };
  KeptRuns(const std::string& what, const Count& count, OutputFolder& folder, bool quiet);

  /// Writes the known runs to the file; from here on it grows by whole lines. Returns the program's
  /// exit status.
  int begin(const std::function<void(std::ostream&)>& content);
  int begin(const std::string& content);
  /// A run has ended.
  void add(const std::string& line);
  /// Shows the progress; true: give up.
  bool stop();
  /// The runs that have ended are enough.
  void stop_early() { count_.todo = ended_; }
  /// Returns the program's exit status; prints a message if not all runs have ended.
  int end();

 private:
  Progress progress_;
  Count count_;
  OutputFolder* folder_;
  std::filesystem::path path_;
  std::ofstream file_;
  std::size_t ended_ = 0;
  bool quiet_;
};

}  // namespace supercoil::host_sim
