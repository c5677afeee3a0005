// Files that the user names: read whole, and never half written.
#pragma once

#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

#include "storage/files.hpp"

namespace supercoil::operating {

/// Writes "PATH.part" and renames it when it is complete. Without commit() nothing of it remains,
/// and a file that existed before is unchanged.
class OutputFile {
 public:
  /// The error says why it cannot be written there. files must outlive it.
  static Result<OutputFile> open(const std::string& path, storage::Files& files);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  Result<void> write(std::string_view part);
  /// Gives the file its name. Call once; nothing can be written after it.
  Result<void> commit();

 private:
  OutputFile(std::string path, storage::NewFile file, storage::Files& files)
      : path_(std::move(path)), file_(std::move(file)), files_(&files) {}

  std::string path_;
  storage::NewFile file_;
  storage::Files* files_;  ///< null: moved from
  bool open_ = true;
  bool kept_ = false;
};

/// Whether writing a file of this name would replace or remove the input, also by a link or as the
/// file that is not complete yet.
bool would_replace(const std::string& path, const std::string& input);

/// Reads at most 1 GiB. The error names the file and the reason.
Result<std::string> read_file(const std::string& path);

/// Writes a whole file, replacing an existing one.
Result<void> write_file(const std::string& path, const std::string& text);

}  // namespace supercoil::operating
