#include "supercoil/identification/csv.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>

namespace supercoil::identification {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view around = " \t\r\"";
  const std::size_t from = text.find_first_not_of(around);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(around) - from + 1);
}

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

}  // namespace

CsvLines::CsvLines(std::string_view text)
    : text_(text), line_end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
}

bool CsvLines::next() {
  while (!text_.empty()) {
    const std::size_t end = text_.find(line_end_);
    const std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++number_;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    if (separator_ == '\0') separator_ = separator_of(line);
    split(line);
    return true;
  }
  return false;
}

void CsvLines::split(std::string_view line) {
  fields_.clear();
  if (separator_ == ' ') line = trimmed(line);
  while (true) {
    const std::size_t end = line.find(separator_);
    fields_.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
    if (separator_ == ' ') line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  }
}

std::optional<double> CsvLines::number_in(std::string_view field) const {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (field.front() == '+') field.remove_prefix(1);
  std::string with_point;
  if (separator_ == ';' && field.find(',') != std::string_view::npos) {
    with_point = field;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    field = with_point;
  }
  double value = 0.0;
  const char* const end = field.data() + field.size();
  const auto [stopped, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

}  // namespace supercoil::identification
