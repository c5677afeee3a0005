#include "apps/supercoil/site_files.hpp"

#include <algorithm>
#include <system_error>

namespace supercoil::operating {

std::optional<std::filesystem::path> find_site_file(const std::filesystem::path& folder,
                                                    std::string_view path) {
  // The operating system would take a path with a NUL for the part before it.
  if (path.find('\0') != std::string_view::npos) return std::nullopt;
  std::error_code error;
  const auto site = std::filesystem::canonical(folder, error);
  if (error) return std::nullopt;
  auto wanted = site / std::filesystem::path(path).relative_path();
  if (std::filesystem::is_directory(wanted, error)) wanted /= "index.html";
  // Compared after ".." and links are followed.
  auto found = std::filesystem::canonical(wanted, error);
  if (error || !std::filesystem::is_regular_file(found, error)) return std::nullopt;
  const auto ends = std::mismatch(site.begin(), site.end(), found.begin(), found.end());
  if (ends.first != site.end()) return std::nullopt;
  return found;
}

}  // namespace supercoil::operating
