// A file that somebody names: read whole, and never half written.
#pragma once

#include <string>
#include <string_view>

#include "supercoil/hal/error.hpp"

#include "storage/files.hpp"

namespace supercoil::operating {

/// Written as "PATH.part" and renamed when it is complete. Without commit() nothing remains of it,
/// and a file that was there before stays as it was.
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
  /// Gives it its name. Once; nothing can be written after it.
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

/// At most 1 GiB. The error names the file, and says why not.
Result<std::string> read_whole(const std::string& path);

/// Writes a file whole, in place of one that may be there.
Result<void> write_whole(const std::string& path, const std::string& text);

}  // namespace supercoil::operating
