#include "report/output_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace supercoil::host_sim {

namespace fs = std::filesystem;

namespace {

std::string reason() {
  return std::generic_category().message(errno);
}

}  // namespace

Result<OutputFolder> OutputFolder::open(const fs::path& folder) {
  const auto refuse = [&](const std::string& why) { return failure(folder.string() + ": " + why); };
  OutputFolder result(folder);
  std::error_code error;
  for (fs::path missing = fs::absolute(folder); !fs::exists(missing, error) && !error;
       missing = missing.parent_path()) {
    result.made_.push_back(missing);
  }
  fs::create_directories(folder, error);
  if (error) return refuse("cannot be created: " + error.message());
  if (!fs::is_directory(folder, error)) return refuse("is not a folder");
  // Root may write whatever the mode says, but not to a read-only file system: try it.
  std::string probe = (folder / ".supercoil-XXXXXX").string();
  const int written = mkstemp(probe.data());
  if (written < 0) return refuse("cannot be written to: " + reason());
  close(written);
  fs::remove(probe, error);
  result.lock_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (result.lock_ < 0 || flock(result.lock_, LOCK_EX | LOCK_NB) != 0) {
    result.made_.clear();
    return refuse("another run is writing into it");
  }
  return result;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : folder_(std::move(other.folder_)),
      made_(std::exchange(other.made_, {})),
      names_(std::exchange(other.names_, {})),
      superseded_(std::exchange(other.superseded_, {})),
      lock_(std::exchange(other.lock_, -1)) {}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const std::string& name : names_)
    fs::remove(folder_ / (name + ".part"), ignored);
  for (const fs::path& folder : made_)
    fs::remove(folder, ignored);  // only if it is empty
  if (lock_ >= 0) close(lock_);
}

fs::path OutputFolder::temporary(const std::string& name) {
  names_.push_back(name);
  return folder_ / (name + ".part");
}

Result<void> OutputFolder::write(const std::string& name, const std::string& content) {
  return write(name, [&](std::ostream& out) { out << content; });
}

Result<void> OutputFolder::write(const std::string& name,
                                 const std::function<void(std::ostream&)>& content) {
  const fs::path path = temporary(name);
  std::ofstream out(path, std::ios::binary);
  content(out);
  out.close();
  if (!out) return failed_call((folder_ / name).string() + ": cannot be written", errno);
  return {};
}

void OutputFolder::drop(const std::string& name) {
  std::error_code ignored;
  fs::remove(folder_ / (name + ".part"), ignored);
  std::erase(names_, name);
}

Result<void> OutputFolder::commit() {
  // Looks for whatever would fail before the first file gets its name.
  for (const std::string& name : names_) {
    if (fs::is_directory(folder_ / name)) {
      return failure((folder_ / name).string() + ": cannot be written: is a folder");
    }
  }
  for (const std::string& name : names_) {
    std::error_code error;
    fs::rename(folder_ / (name + ".part"), folder_ / name, error);
    if (error) {
      return failed_call((folder_ / name).string() + ": cannot be written", error.value());
    }
  }
  std::error_code ignored;
  for (const std::string& name : superseded_)
    fs::remove(folder_ / name, ignored);
  names_.clear();
  made_.clear();
  return {};
}

}  // namespace supercoil::host_sim
