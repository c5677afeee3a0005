// One daemon a board.
#pragma once

#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::linux_board {

/// Holds a lock for as long as it lives. The kernel drops it with the process, however that ends.
class LockFile {
 public:
  /// Makes the file, and writes into nothing but a regular file of one name that belongs to root,
  /// to this user or to its folder's owner: no link is followed. The error names who holds it, or
  /// what is wrong with the path.
  static Result<LockFile> take(const std::string& path);

 private:
  explicit LockFile(hal_linux::Descriptor file) : file_(std::move(file)) {}
  hal_linux::Descriptor file_;
};

}  // namespace supercoil::linux_board
