#include "report/output_folder.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace supercoil::host_sim {

namespace fs = std::filesystem;

namespace {

std::string reason() {
  return std::generic_category().message(errno);
}

}  // namespace

tl::expected<OutputFolder, std::string> OutputFolder::open(const fs::path& folder) {
  OutputFolder result(folder);
  std::error_code error;
  result.made_ = fs::create_directories(folder, error);
  if (error) {
    return tl::unexpected(folder.string() + ": cannot be made: " + error.message());
  }
  if (!fs::is_directory(folder, error)) {
    return tl::unexpected(folder.string() + ": is not a folder");
  }
  // Root may write where the mode says otherwise, but not into a file system that is read-only.
  const fs::path probe = result.temporary("probe");
  result.names_.clear();
  const bool writable = std::ofstream(probe).good();
  const std::string why = reason();
  fs::remove(probe, error);
  if (!writable) return tl::unexpected(folder.string() + ": cannot be written to: " + why);
  return result;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : folder_(std::move(other.folder_)),
      made_(std::exchange(other.made_, false)),
      names_(std::exchange(other.names_, {})) {}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const std::string& name : names_)
    fs::remove(folder_ / (name + ".part"), ignored);
  if (made_) fs::remove(folder_, ignored);  // only when it is empty
}

fs::path OutputFolder::temporary(const std::string& name) {
  names_.push_back(name);
  return folder_ / (name + ".part");
}

tl::expected<void, std::string> OutputFolder::write(const std::string& name,
                                                    const std::string& content) {
  const fs::path path = temporary(name);
  std::ofstream out(path, std::ios::binary);
  out << content;
  out.close();
  if (!out) return tl::unexpected((folder_ / name).string() + ": cannot be written: " + reason());
  return {};
}

void OutputFolder::drop(const std::string& name) {
  std::error_code ignored;
  fs::remove(folder_ / (name + ".part"), ignored);
  std::erase(names_, name);
}

tl::expected<void, std::string> OutputFolder::commit() {
  for (const std::string& name : names_) {
    std::error_code error;
    fs::rename(folder_ / (name + ".part"), folder_ / name, error);
    if (error) {
      return tl::unexpected((folder_ / name).string() + ": cannot be written: " + error.message());
    }
  }
  names_.clear();
  made_ = false;
  return {};
}

}  // namespace supercoil::host_sim
