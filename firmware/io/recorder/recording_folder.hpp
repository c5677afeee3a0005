// The folder of flight recordings: numbers them, limits how many are kept, writes new ones.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "storage/files.hpp"

namespace supercoil::recorder {

/// The names of everything in a folder, in any order.
using ListFolder = std::function<Result<std::vector<std::string>>(const std::string& folder)>;
/// Asks the operating system.
Result<std::vector<std::string>> list_folder(const std::string& folder);

/// The number of "flight-12.scfr"; 0 for any other name.
std::uint64_t number_of(std::string_view name);

/// Where recordings are kept, as flight-1.scfr and so on.
class RecordingFolder {
 public:
  /// max_files: recordings that may exist after one was written, 1 or more.
  RecordingFolder(std::string folder, std::size_t max_files, ListFolder list, storage::Files& files)
      : folder_(std::move(folder)), max_files_(max_files), list_(std::move(list)), files_(&files) {}

  /// A recording that is on the disk.
  struct Written {
    std::string path;
    /// What went wrong nevertheless, such as an old file that could not be removed.
    std::vector<std::string> problems;
  };
  /// Writes a recording that consists of these parts. Its number is greater than any in the folder
  /// and any given before. Removes old recordings first: a full disk needs their space. After an
  /// error it removes what is half-written, if it can. Blocks for as long as the disk takes.
  Result<Written> write(std::span<const std::string_view> parts);

 private:
  Result<void> write_file(const std::string& path, std::span<const std::string_view> parts);
  void remove_left_over(const std::vector<std::string>& names);
  std::vector<std::string> make_room(const std::vector<std::uint64_t>& numbers);
  std::string path_of(std::uint64_t number) const;

  std::string folder_;
  std::size_t max_files_;
  ListFolder list_;
  storage::Files* files_;
  std::uint64_t last_ = 0;
};

}  // namespace supercoil::recorder
