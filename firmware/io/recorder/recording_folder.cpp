#include "recorder/recording_folder.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace supercoil::recorder {

namespace {

constexpr std::string_view prefix = "flight-";
constexpr std::string_view suffix = ".scfr";
constexpr std::string_view unfinished = ".new";
/// Longer numbers are not ours: the next number must still fit into 64 bits.
constexpr std::size_t max_digits = 18;

}  // namespace

Result<std::vector<std::string>> list_folder(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    names.push_back(entry->path().filename().string());
  if (error) return failed_call(folder + ": cannot be listed", error.value());
  return names;
}

std::uint64_t number_of(std::string_view name) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return 0;
  if (name.size() <= prefix.size() + suffix.size()) return 0;
  const std::string_view digits =
      name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  if (digits.size() > max_digits || digits.front() == '0') return 0;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() ? number : 0;
}

std::string RecordingFolder::path_of(std::uint64_t number) const {
  return folder_ + "/" + std::string(prefix) + std::to_string(number) + std::string(suffix);
}

Result<RecordingFolder::Written> RecordingFolder::write(std::span<const std::string_view> parts) {
  const auto names = list_(folder_);
  if (!names) return tl::unexpected(names.error());
  std::vector<std::uint64_t> numbers;
  for (const std::string& name : *names) {
    if (const std::uint64_t number = number_of(name); number != 0) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  if (!numbers.empty()) last_ = std::max(last_, numbers.back());

  remove_left_over(*names);
  Written written;
  written.problems = make_room(numbers);
  written.path = path_of(last_ + 1);
  const std::string temporary = written.path + std::string(unfinished);
  auto result = write_file(temporary, parts);
  if (result) result = files_->rename(temporary, written.path);
  if (!result) {
    static_cast<void>(files_->unlink(temporary));  // a full disk needs the room
    return tl::unexpected(result.error());
  }
  ++last_;
  // The file is complete; only a power cut could still undo its name.
  if (const auto synced = files_->sync_folder(folder_); !synced)
    written.problems.push_back(synced.error().text());
  return written;
}

Result<void> RecordingFolder::write_file(const std::string& path,
                                         std::span<const std::string_view> parts) {
  const auto file = files_->create(path);
  if (!file) return tl::unexpected(file.error());
  Result<void> result;
  for (const std::string_view part : parts) {
    if (result && !part.empty()) result = files_->write(*file, part);
  }
  if (result) result = files_->sync(*file);
  const auto closed = files_->close(*file);
  return result ? closed : result;
}

void RecordingFolder::remove_left_over(const std::vector<std::string>& names) {
  for (const std::string_view name : names) {
    if (!name.ends_with(unfinished)) continue;
    if (number_of(name.substr(0, name.size() - unfinished.size())) == 0) continue;
    // If it cannot be removed and is in the way, creating the file fails and says so.
    static_cast<void>(files_->unlink(folder_ + "/" + std::string(name)));
  }
}

std::vector<std::string> RecordingFolder::make_room(const std::vector<std::uint64_t>& numbers) {
  std::vector<std::string> problems;
  std::size_t there = numbers.size();
  for (const std::uint64_t oldest : numbers) {
    if (there < max_files_) break;
    const auto removed = files_->unlink(path_of(oldest));
    // A file that stays must not cost a new one its place: the next oldest goes instead.
    if (removed || removed.error().code == std::errc::no_such_file_or_directory) {
      --there;
    } else {
      problems.push_back(removed.error().text());
    }
  }
  return problems;
}

}  // namespace supercoil::recorder
