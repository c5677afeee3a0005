#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "supercoil/identification/recording.hpp"
#include "supercoil/identification/units.hpp"

namespace supercoil::identification {

namespace {

using Fields = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view around = " \t\r\"";
  const std::size_t from = text.find_first_not_of(around);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(around) - from + 1);
}

/// Of the line of names: what there is of these, in this order; else spaces.
char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

void split(std::string_view line, char separator, Fields& fields) {
  fields.clear();
  if (separator == ' ') line = trimmed(line);
  while (true) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
    if (separator == ' ') line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  }
}

/// NaN for an empty field and for "nan"; empty for what is NaN.
std::optional<double> number_in(std::string_view field, char separator) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (field.front() == '+') field.remove_prefix(1);
  std::string with_point;
  if (separator == ';' && field.find(',') != std::string_view::npos) {
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

std::string list_of(const Fields& names) {
  std::string result;
  for (const std::string_view name : names)
    result += (result.empty() ? "" : ", ") + std::string(name);
  return result;
}

/// What it is called in messages and options, and in files: what is more likely comes first.
struct Wanted {
  Quantity quantity;
  const char* name;
  std::array<std::string_view, 5> called;
};
constexpr Wanted wanted_time{
    Quantity::time, "time", {"time", "t", "timestamp", "seconds", "clock"}};
constexpr Wanted wanted_position{
    Quantity::position, "position", {"measured", "position", "contraction", "displacement", "x"}};
constexpr Wanted wanted_power{
    Quantity::power, "power", {"applied_power", "applied", "power", "heat", "p"}};

struct Found {
  std::size_t index;
  double size;  ///< of one in the file, in SI
  std::string name;
};

std::optional<std::size_t> index_of(const Fields& names, const Wanted& wanted,
                                    const std::string& column) {
  if (!column.empty()) {
    const auto named = std::find(names.begin(), names.end(), column);
    if (named != names.end()) return static_cast<std::size_t>(named - names.begin());
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), number);
    const bool whole = error == std::errc{} && end == column.data() + column.size();
    if (whole && number >= 1 && number <= names.size()) return number - 1;
    return std::nullopt;
  }
  for (const std::string_view called : wanted.called)
    for (std::size_t i = 0; i < names.size(); ++i)
      if (split_name(wanted.quantity, names[i]).name == called) return i;
  return std::nullopt;
}

tl::expected<Found, Problem> find_column(const Fields& names, std::size_t line,
                                         const Wanted& wanted, const Column& column) {
  const std::string option = std::string("--") + wanted.name;
  const auto index = index_of(names, wanted, column.name);
  if (!index) {
    return tl::unexpected(Problem{
        line, (column.name.empty() ? std::string("has no column that is known as ") + wanted.name +
                                         "; name it with " + option + "-column"
                                   : option + "-column " + column.name + ": there is none") +
                  "; the columns are " + list_of(names)});
  }
  std::string unit = column.unit;
  if (unit.empty()) unit = split_name(wanted.quantity, names[*index]).unit;
  const auto size = unit.empty() ? 1.0 : unit_size(wanted.quantity, unit);
  if (!size) {
    return tl::unexpected(
        Problem{0, option + "-unit " + unit + ": must be one of " + units_of(wanted.quantity)});
  }
  return Found{*index, *size * column.scale, std::string(names[*index])};
}

class CsvReader {
 public:
  CsvReader(std::string_view text, const Columns& columns) : text_(text), columns_(columns) {}

  tl::expected<Recording, Problem> read() {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
    if (!next_line()) return tl::unexpected(Problem{0, "is empty"});
    if (auto found = read_names(); !found) return tl::unexpected(found.error());
    while (next_line())
      if (auto added = add_row(); !added) return tl::unexpected(added.error());
    return std::move(recording_);
  }

 private:
  /// The next that is neither empty nor a comment.
  bool next_line() {
    while (!text_.empty()) {
      const std::size_t end = text_.find('\n');
      line_ = text_.substr(0, end);
      text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
      ++number_;
      const std::string_view content = trimmed(line_);
      if (!content.empty() && content.front() != '#') return true;
    }
    return false;
  }

  tl::expected<void, Problem> read_names() {
    separator_ = separator_of(line_);
    split(line_, separator_, fields_);
    names_ = fields_.size();
    if (number_in(fields_.front(), separator_)) {
      return tl::unexpected(Problem{number_,
                                    "begins with numbers: its first line must name the "
                                    "columns, e.g. time_s,position_m,power_W"});
    }
    const std::array<const Wanted*, 3> wanted{&wanted_time, &wanted_position, &wanted_power};
    const std::array<const Column*, 3> columns{&columns_.time, &columns_.position, &columns_.power};
    for (std::size_t i = 0; i < 3; ++i) {
      auto found = find_column(fields_, number_, *wanted[i], *columns[i]);
      if (!found) return tl::unexpected(found.error());
      found_[i] = *found;
    }
    const auto channel = std::find(fields_.begin(), fields_.end(), "channel");
    if (channel != fields_.end()) channel_at_ = static_cast<std::size_t>(channel - fields_.begin());
    return {};
  }

  tl::expected<void, Problem> add_row() {
    split(line_, separator_, fields_);
    if (fields_.size() != names_) {
      return tl::unexpected(Problem{number_, "has " + std::to_string(fields_.size()) +
                                                 " fields; there are " + std::to_string(names_) +
                                                 " columns"});
    }
    if (channel_at_ && columns_.channel == 0) {
      if (first_channel_.empty()) first_channel_ = fields_[*channel_at_];
      if (fields_[*channel_at_] != first_channel_)
        return tl::unexpected(Problem{number_, "is of another channel: say which by --channel"});
    } else if (channel_at_ && fields_[*channel_at_] != std::to_string(columns_.channel)) {
      return {};
    }
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view field = fields_[found_[i].index];
      const auto value = number_in(field, separator_);
      if (!value) {
        return tl::unexpected(
            Problem{number_, found_[i].name + ": \"" + std::string(field) + "\" is not a number"});
      }
      if (i != 1 && std::isnan(*value)) {
        return tl::unexpected(
            Problem{number_, found_[i].name + (field.empty() ? " is missing" : " is NaN")});
      }
      values[i] = *value * found_[i].size;
    }
    recording_.time_s.push_back(values[0]);
    recording_.position_m.push_back(values[1]);
    recording_.power_W.push_back(values[2]);
    recording_.line.push_back(number_);
    return {};
  }

  std::string_view text_;
  const Columns& columns_;
  std::string_view line_;
  std::size_t number_ = 0;
  char separator_ = ',';
  Fields fields_;
  std::size_t names_ = 0;
  std::array<Found, 3> found_{};
  std::optional<std::size_t> channel_at_;
  std::string first_channel_;
  Recording recording_;
};

}  // namespace

tl::expected<Recording, Problem> read_csv(std::string_view text, const Columns& columns) {
  return CsvReader(text, columns).read();
}

}  // namespace supercoil::identification
