// The keys that a file may have, as its readers ask for them: for the option keys, and for the
// tables in docs/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace supercoil::config {

/// Minimum and maximum allowed value, inclusive.
struct Range {
  double min;
  double max;
};

/// Any number. Whoever says what is allowed leaves this range out.
inline constexpr Range any_number{-1e300, 1e300};
/// Whether it limits nothing.
constexpr bool is_any(const Range& range) {
  return range.min <= any_number.min && range.max >= any_number.max;
}

/// "0 to 255" or "1 or more". min, max: the range's ends as text.
inline std::string range_text(const Range& range, const std::string& min, const std::string& max) {
  return range.max >= any_number.max ? min + " or more" : min + " to " + max;
}

/// monostate: none. Numbers are finite, lists and texts are not empty.
using KeyValue = std::variant<std::monostate, bool, std::int64_t, double, std::string,
                              std::vector<double>, std::vector<std::string>>;

/// One key of a file, and what it may be.
struct Key {
  std::string name{};  ///< with its table: channel[1].limits.max_W
  /// number, integer, flag or text; numbers, texts or values: a list, of values also mixed
  std::string_view type{};
  KeyValue fallback{};           ///< its default
  KeyValue value{};              ///< in force
  std::optional<Range> range{};  ///< of a number, or of each in a list
  std::size_t min_count = 0;     ///< of a list
  std::size_t max_count = 0;
  std::vector<std::string> names{};  ///< allowed texts; empty: any
  bool required = false;
  int line = 0;  ///< where the file has it; 0: it does not
};

using KeyList = std::vector<Key>;

/// What a key may be: "0 to 255"; empty: any number or text.
std::string allowed_text(const Key& key);

/// A line each: value, default, the file's line, and what is allowed.
std::string to_text(const KeyList& keys);

}  // namespace supercoil::config
