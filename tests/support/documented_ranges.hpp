// The ranges in a page's tables of keys: "| `a`, `b` | 0 to 10, 1 to 5 [2: a default] | … |".
#pragma once

#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace supercoil::test {

struct DocumentedRange {
  std::string key;
  double min;
  double max;
  double fallback;  ///< NaN: none is given
};

/// Of all tables whose header begins with key and range. A row with one range has it for all of its
/// keys; one with none is left out.
inline std::vector<DocumentedRange> documented_ranges(const std::string& path) {
  static const std::regex quoted("`([^`]+)`");
  static const std::regex range(R"((\S+) to ([-+.e\d]+)(?: \[([-+.e\d]+))?)");
  std::ifstream page(path);
  std::vector<DocumentedRange> all;
  bool in_table = false;
  for (std::string line; std::getline(page, line);) {
    in_table = line.starts_with("| key | range |") || (in_table && line.starts_with("|"));
    if (!in_table || !line.starts_with("| `")) continue;
    const std::size_t first_end = line.find(" | ");
    const std::string names = line.substr(0, first_end);
    const std::string cell = line.substr(first_end, line.find(" |", first_end + 1) - first_end);
    const std::vector<std::smatch> ranges{std::sregex_iterator(cell.begin(), cell.end(), range),
                                          std::sregex_iterator()};
    std::size_t place = 0;
    for (std::sregex_iterator name(names.begin(), names.end(), quoted), end; name != end; ++name) {
      if (ranges.empty()) break;
      const std::smatch& own = ranges[ranges.size() == 1 ? 0 : place++];
      all.push_back({(*name)[1], std::stod(own[1]), std::stod(own[2]),
                     own[3].matched ? std::stod(own[3]) : NAN});
    }
  }
  return all;
}

}  // namespace supercoil::test
