// One daemon per board.
#pragma once

#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::linux_board {

/// Holds a lock for as long as it lives. The kernel releases it when the process ends, in any way.
class LockFile {
 public:
  /// Creates the file. Writes only to a regular file with a single name that belongs to root, to
  /// this user or to its folder's owner; follows no link. The error names the process that holds
  /// the lock, or what is wrong with the path.
  static Result<LockFile> take(const std::string& path);

 private:
  explicit LockFile(hal_linux::Descriptor file) : file_(std::move(file)) {}
  hal_linux::Descriptor file_;
};

}  // namespace supercoil::linux_board
