#include "apps/supercoil/user_file.hpp"

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "storage/posix_files.hpp"

namespace supercoil::operating {

namespace {

std::string temporary_name(const std::string& path) {
  return path + ".part";
}

}  // namespace

bool would_replace(const std::string& path, const std::string& input) {
  std::error_code ignored;
  return std::filesystem::equivalent(path, input, ignored) ||
         std::filesystem::equivalent(temporary_name(path), input, ignored);
}

Result<OutputFile> OutputFile::open(const std::string& path, storage::Files& files) {
  // A device or a folder must not be replaced by a file.
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return failure(path + ": is not a file");
  const std::string temporary = temporary_name(path);
  static_cast<void>(files.unlink(temporary));  // left over from a killed run
  auto file = files.create(temporary);
  if (!file) return tl::unexpected(file.error());
  return OutputFile(path, std::move(*file), files);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::move(other.file_)),
      files_(std::exchange(other.files_, nullptr)),
      open_(other.open_),
      kept_(other.kept_) {}

OutputFile::~OutputFile() {
  if (files_ == nullptr) return;
  if (open_) static_cast<void>(files_->close(file_));
  if (!kept_) static_cast<void>(files_->unlink(file_.path));
}

Result<void> OutputFile::write(std::string_view part) {
  return files_->write(file_, part);
}

Result<void> OutputFile::commit() {
  auto result = files_->sync(file_);
  open_ = false;
  const auto closed = files_->close(file_);
  if (result) result = closed;
  if (result) result = files_->rename(file_.path, path_);
  kept_ = result.has_value();
  return result;
}

Result<std::string> read_file(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr std::uintmax_t max_bytes = 1ULL << 30;
  std::error_code error;
  if (!fs::exists(path, error)) return failure(path + ": there is no such file");
  if (!fs::is_regular_file(path, error)) return failure(path + ": is not a file");
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (error) return failed_call(path + ": cannot be read", error.value());
  if (bytes > max_bytes) return failure(path + ": is larger than 1 GiB");
  storage::PosixFiles files;
  return files.read(path, bytes);
}

Result<void> write_file(const std::string& path, const std::string& text) {
  storage::PosixFiles files;
  auto file = OutputFile::open(path, files);
  if (!file) return tl::unexpected(file.error());
  if (auto written = file->write(text); !written) return written;
  return file->commit();
}

}  // namespace supercoil::operating
