// A stored file as it was found.
#pragma once

#include <optional>
#include <string>

#include "board/learned.hpp"
#include "storage/files.hpp"

namespace supercoil::storage {

/// A stored set, or why there is none.
struct Examined {
  bool exists = false;
  std::optional<board::Learned> learned;  ///< empty: absent or damaged
  std::string problem;                    ///< "path: what is wrong"; empty when it is good

  bool damaged() const { return exists && !learned; }
};

/// Reads and decodes a file. A file that cannot be read (EIO, no permission) counts as damaged,
/// because it needs the same protection.
Examined examine(Files& files, const std::string& path);

}  // namespace supercoil::storage
