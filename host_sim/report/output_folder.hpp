// A folder of results that is never half written.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

namespace supercoil::host_sim {

/// Files are written under temporary names and get their own when all are complete. Without
/// commit() (an error, an exception) nothing of this run remains, and files of an earlier run stay
/// as they were.
class OutputFolder {
 public:
  /// Makes the folder where it is missing. The error says why it cannot be written to.
  static Result<OutputFolder> open(const std::filesystem::path& folder);

  OutputFolder(OutputFolder&& other) noexcept;
  OutputFolder& operator=(OutputFolder&&) = delete;
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

  /// Where to write the file that will be called name.
  std::filesystem::path temporary(const std::string& name);
  /// Writes a whole file; the error says why it failed (a full disk, for one).
  Result<void> write(const std::string& name, const std::string& content);
  /// The same for a file that should not be in memory as a whole.
  Result<void> write(const std::string& name, const std::function<void(std::ostream&)>& content);
  /// Gives up a file that temporary() announced; the others are kept.
  void drop(const std::string& name);
  /// commit() then removes this file of an earlier run, which this run does not replace.
  void supersede(const std::string& name) { superseded_.push_back(name); }
  /// Gives every file its name.
  Result<void> commit();

  const std::filesystem::path& path() const { return folder_; }

 private:
  explicit OutputFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  ///< folders made for this run, innermost first
  std::vector<std::string> names_;
  std::vector<std::string> superseded_;
  int lock_ = -1;  ///< the folder itself, locked: two runs would mix their temporary files
};

}  // namespace supercoil::host_sim
