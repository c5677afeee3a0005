// The file calls that storage needs; tests can make each fail, or cut the power at it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

namespace supercoil::storage {

/// A file being written.
struct NewFile {
  int descriptor;
  std::string path;
};

/// Every call may block for as long as the disk takes: never call one from the control loop. None
/// throws. An error has the path and errno's value: ENOENT for a missing file or folder.
class Files {
 public:
  virtual ~Files() = default;

  /// The whole content, or its first limit_bytes.
  virtual Result<std::string> read(const std::string& path, std::size_t limit_bytes) = 0;
  /// Creates an empty file; EEXIST when it exists. It must be closed, whatever happens to it.
  virtual Result<NewFile> create(const std::string& path) = 0;
  /// Writes the whole content. After an error, any part of it may be in the file.
  virtual Result<void> write(const NewFile& file, std::string_view content) = 0;
  /// On success the content is on the disk. An error does not tell which part is, and a successful
  /// retry does not mean that all is (Linux drops the failed pages): write a new file instead.
  virtual Result<void> sync(const NewFile& file) = 0;
  /// The descriptor is gone in any case, even after an error.
  virtual Result<void> close(const NewFile& file) = 0;
  /// Atomic; replaces an existing `to`. Does nothing when both are names of one file.
  virtual Result<void> rename(const std::string& from, const std::string& to) = 0;
  /// A second name for the same file; EEXIST when that name is taken.
  virtual Result<void> link(const std::string& from, const std::string& to) = 0;
  /// Removes a name; the content goes with the file's last one.
  virtual Result<void> unlink(const std::string& path) = 0;
  /// Puts the folder's names on the disk; until then a power cut may undo any change of them.
  virtual Result<void> sync_folder(const std::string& path) = 0;
  /// Checks that the folder exists and can be opened.
  virtual Result<void> check_folder(const std::string& path) = 0;

 protected:
  Files() = default;
  Files(const Files&) = default;
  Files& operator=(const Files&) = default;
};

}  // namespace supercoil::storage
