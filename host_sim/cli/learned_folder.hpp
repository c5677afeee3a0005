// What a simulated board learned, in a folder, as a board keeps it.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "runner/simulation.hpp"
#include "storage/posix_files.hpp"
#include "storage/store.hpp"

namespace supercoil::host_sim {

/// One file for each channel of one board.
class LearnedFolder {
 public:
  /// path: empty: nothing is remembered. Touches nothing yet.
  explicit LearnedFolder(const std::string& path) : kept_(!path.empty()) {
    for (std::size_t i = 0; i < max_muscles; ++i)
      stores_.emplace_back(path, static_cast<int>(i + 1), files_);
  }

  /// What is wrong with what was stored, beside that, is printed. The error says why nothing can be
  /// read.
  tl::expected<LearnedMuscles, std::string> load();
  /// What identify or calibrate found. The error says what could not be kept.
  tl::expected<void, std::string> save(const Simulation& simulation);

 private:
  bool kept_;
  storage::PosixFiles files_;
  std::vector<storage::LearnedStore> stores_;
};

}  // namespace supercoil::host_sim
