// What a simulated board learned, in a folder, as a board keeps it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "scenario/scenario.hpp"
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
  Result<LearnedMuscles> load();
  /// As a board stores it, at once: a run that is killed has it. Empty: forgets the muscle. What
  /// cannot be stored is printed.
  void store(std::size_t channel, const board::LearnedUpdate& update);
  /// Nothing of what was learned is lost.
  bool complete() const { return complete_; }

 private:
  bool kept_;
  bool complete_ = true;
  storage::PosixFiles files_;
  std::vector<storage::LearnedStore> stores_;
};

}  // namespace supercoil::host_sim
