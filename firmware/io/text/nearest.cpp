#include "text/nearest.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace supercoil {

namespace {

/// Levenshtein distance that counts two swapped neighbours as one edit: "amr" for "arm".
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// The written name may lack the last parts of a known one, and be misspelt too.
Nearest nearest_beginning(std::string_view written, const std::vector<std::string>& known) {
  Nearest best;
  std::size_t min_distance = 0;
  for (const std::string& name : known) {
    for (std::size_t end = name.find('_'); end != std::string::npos;
         end = name.find('_', end + 1)) {
      const std::size_t distance = edits(written, std::string_view(name).substr(0, end));
      const bool nearer = best.name.empty() || distance < min_distance ||
                          (distance == min_distance && name.size() < best.name.size());
      if (distance > end / 4 || !nearer) continue;
      best = {name, true};
      min_distance = distance;
    }
  }
  return best;
}

}  // namespace

Nearest nearest_name(std::string_view written, const std::vector<std::string>& known) {
  const std::string with_unit = std::string(written) + "_";
  Nearest best;
  std::size_t min_distance = 0;
  for (const std::string& name : known) {
    // The shortest of these names adds nothing but a unit.
    if (name.starts_with(with_unit) && (!best.lacks_unit || name.size() < best.name.size()))
      best = {name, true};
    const std::size_t distance = edits(written, name);
    if (!best.lacks_unit && distance <= name.size() / 3 &&
        (best.name.empty() || distance < min_distance)) {
      best.name = name;
      min_distance = distance;
    }
  }
  return best.name.empty() ? nearest_beginning(written, known) : best;
}

std::string suggestion_or_all(std::string_view written, const std::vector<std::string>& known,
                              std::string_view otherwise) {
  const Nearest nearest = nearest_name(written, known);
  if (nearest.name.empty()) return std::string(otherwise) + ": " + joined(known);
  // A numbered name such as "gain_1" has no unit.
  const bool lacks_unit =
      nearest.lacks_unit && (nearest.name.back() < '0' || nearest.name.back() > '9');
  return "did you mean " + nearest.name + (lacks_unit ? " (the unit is part of the name)?" : "?");
}

std::string joined(const std::vector<std::string>& names) {
  std::string result;
  for (const std::string& name : names)
    result += (result.empty() ? "" : ", ") + name;
  return result;
}

}  // namespace supercoil
