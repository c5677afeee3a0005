// A comparison whose runs are kept as they end, and go on after an interruption.
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

  /// Writes the file as it is known; from here on it is whole, and grows by whole lines. Returns
  /// the program's exit status if that failed.
  int begin(const std::function<void(std::ostream&)>& content);
  int begin(const std::string& content);
  /// A run has ended.
  void add(const std::string& line);
  /// Shows how far it is; true: give up.
  bool stop();
  /// What has ended is all that was wanted.
  void enough() { count_.todo = ended_; }
  /// The program's exit status; a message where not all have ended.
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
