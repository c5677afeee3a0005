// The page's files and the faults' texts, inside the program.
#pragma once

#include <span>
#include <string_view>

namespace supercoil::operating {

struct Asset {
  std::string_view name;  ///< "index.html"; for a fault's text its name without ending
  std::string_view text;
};

std::span<const Asset> page_files();
std::span<const Asset> fault_pages();
/// Null: no asset has this name.
const Asset* find_asset(std::span<const Asset> assets, std::string_view name);
/// From the ending of the name.
std::string_view media_type(std::string_view name);

}  // namespace supercoil::operating
