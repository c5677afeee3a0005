// What a simulated board learned, in a folder, stored as on a board.
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
  /// An empty path remembers nothing. Does not access the folder yet.
  explicit LearnedFolder(const std::string& path) : kept_(!path.empty()) {
    for (std::size_t i = 0; i < max_muscles; ++i)
      stores_.emplace_back(path, static_cast<int>(i + 1), files_);
  }

  /// Prints problems with what was stored. The error says why nothing can be read.
  Result<LearnedMuscles> load();
  /// Stores it like a board, at once: a killed run keeps it. Empty: forgets the muscle. Prints what
  /// cannot be stored.
  void store(std::size_t channel, const board::LearnedUpdate& update);
  /// Whether everything that was learned is stored.
  bool complete() const { return complete_; }

 private:
  bool kept_;
  bool complete_ = true;
  storage::PosixFiles files_;
  std::vector<storage::LearnedStore> stores_;
};

}  // namespace supercoil::host_sim
