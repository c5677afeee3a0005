// What a simulated board learned, in a folder, as a board keeps it.
#pragma once

#include <array>
#include <string>

#include <tl/expected.hpp>

#include "runner/simulation.hpp"
#include "storage/posix_files.hpp"
#include "storage/store.hpp"

namespace supercoil::host_sim {

/// One file for each channel of one board.
class LearnedFolder {
 public:
  /// path: empty: nothing is remembered. Touches nothing yet.
  explicit LearnedFolder(const std::string& path)
      : kept_(!path.empty()),
        stores_{storage::LearnedStore(path, 1, files_), storage::LearnedStore(path, 2, files_)} {}

  /// What is wrong with what was stored, beside that, is printed. The error says why nothing can be
  /// read.
  tl::expected<LearnedMuscles, std::string> load();
  /// What identify or calibrate found. The error says what could not be kept.
  tl::expected<void, std::string> save(const Simulation& simulation);

 private:
  bool kept_;
  storage::PosixFiles files_;
  std::array<storage::LearnedStore, 2> stores_;
};

}  // namespace supercoil::host_sim
