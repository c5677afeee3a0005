#include "apps/supercoil/input_file.hpp"

#include <cstdint>
#include <filesystem>
#include <system_error>

#include "storage/posix_files.hpp"

namespace supercoil::operating {

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
  if (!content) return tl::unexpected(content.error().text);
  return std::move(*content);
}

}  // namespace supercoil::operating
