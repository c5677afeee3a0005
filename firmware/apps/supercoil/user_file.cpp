#include "apps/supercoil/user_file.hpp"

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "storage/posix_files.hpp"

namespace supercoil::operating {

namespace {

tl::expected<void, std::string> text_of(const Result<void>& result) {
  if (result) return {};
  return tl::unexpected(result.error().text());
}

}  // namespace

tl::expected<OutputFile, std::string> OutputFile::open(const std::string& path,
                                                       storage::Files& files) {
  // A device or a folder must not be replaced by a file.
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return tl::unexpected(path + ": is not a file");
  const std::string temporary = path + ".part";
  static_cast<void>(files.unlink(temporary));  // of a run that was killed
  auto file = files.create(temporary);
  if (!file) return tl::unexpected(file.error().text());
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

tl::expected<void, std::string> OutputFile::write(std::string_view part) {
  return text_of(files_->write(file_, part));
}

tl::expected<void, std::string> OutputFile::commit() {
  auto result = files_->sync(file_);
  open_ = false;
  const auto closed = files_->close(file_);
  if (result) result = closed;
  if (result) result = files_->rename(file_.path, path_);
  kept_ = result.has_value();
  return text_of(result);
}

tl::expected<std::string, std::string> read_whole(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr std::uintmax_t max_bytes = 1ULL << 30;
  std::error_code error;
  if (!fs::exists(path, error)) return tl::unexpected(path + ": there is no such file");
  if (!fs::is_regular_file(path, error)) return tl::unexpected(path + ": is not a file");
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (error) return tl::unexpected(path + ": cannot be read: " + error.message());
  if (bytes > max_bytes) return tl::unexpected(path + ": is larger than 1 GiB");
  storage::PosixFiles files;
  auto content = files.read(path, bytes);
  if (!content) return tl::unexpected(content.error().text());
  return std::move(*content);
}

tl::expected<void, std::string> write_whole(const std::string& path, const std::string& text) {
  storage::PosixFiles files;
  auto file = OutputFile::open(path, files);
  if (!file) return tl::unexpected(file.error());
  if (auto written = file->write(text); !written) return written;
  return file->commit();
}

}  // namespace supercoil::operating
