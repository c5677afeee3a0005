// The files of the documentation's site, as requests name them.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace supercoil::operating {

/// The file below folder that a request's path names, decoded already: "/docs/can.html", or of a
/// folder its index.html. None where there is no such file, or where it lies outside of folder.
std::optional<std::filesystem::path> find_site_file(const std::filesystem::path& folder,
                                                    std::string_view path);

}  // namespace supercoil::operating
