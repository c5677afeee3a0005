// CSV as programs and laboratories write it, line by line.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace supercoil::identification {

/// The separator is the first of semicolon, tab and comma that the first line contains, or else
/// spaces. Lines end with \n, \r\n, or \r alone. Empty lines and lines that begin with # are
/// skipped; spaces and quotes around a field are removed.
class CsvLines {
 public:
  /// text must outlive it.
  explicit CsvLines(std::string_view text);

  /// Reads the next line. False: there is none.
  bool next();
  /// The number of this line, from 1; skipped lines count too.
  std::size_t number() const { return number_; }
  const std::vector<std::string_view>& fields() const { return fields_; }
  /// NaN for an empty field and for "nan"; empty if it is not a number. Takes a decimal comma where
  /// semicolons separate.
  std::optional<double> number_in(std::string_view field) const;

 private:
  void split(std::string_view line);

  std::string_view text_;
  char line_end_;  ///< '\r' in a text that has no '\n'
  std::size_t number_ = 0;
  char separator_ = '\0';  ///< before the first line
  std::vector<std::string_view> fields_;
};

}  // namespace supercoil::identification
