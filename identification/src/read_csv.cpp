#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "supercoil/identification/csv.hpp"
#include "supercoil/identification/recording.hpp"
#include "supercoil/identification/units.hpp"

namespace supercoil::identification {

namespace {

using Fields = std::vector<std::string_view>;

std::string list_of(const Fields& names) {
  std::string result;
  for (const std::string_view name : names)
    result += (result.empty() ? "" : ", ") + std::string(name);
  return result;
}

/// A quantity's name in messages and options, and its usual names in files, the likeliest first.
struct ColumnNames {
  Quantity quantity;
  const char* name;
  std::array<std::string_view, 5> aliases;
};
constexpr ColumnNames time_names{
    Quantity::time, "time", {"time", "t", "timestamp", "seconds", "clock"}};
constexpr ColumnNames position_names{
    Quantity::position, "position", {"measured", "position", "contraction", "displacement", "x"}};
constexpr ColumnNames power_names{
    Quantity::power, "power", {"applied_power", "applied", "power", "heat", "p"}};

struct Found {
  std::size_t index;
  double size;  ///< of one unit of the file, in SI
  std::string name;
};

std::optional<std::size_t> index_of(const Fields& names, const ColumnNames& expected,
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
  for (const std::string_view alias : expected.aliases) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (split_name(expected.quantity, names[i]).name == alias) return i;
    }
  }
  return std::nullopt;
}

tl::expected<Found, Problem> find_column(const Fields& names, std::size_t line,
                                         const ColumnNames& expected, const Column& column) {
  const std::string option = std::string("--") + expected.name;
  const auto index = index_of(names, expected, column.name);
  if (!index) {
    return tl::unexpected(Problem{
        line,
        (column.name.empty() ? std::string("has no column recognised as ") + expected.name +
                                   "; name it with " + option + "-column"
                             : option + "-column " + column.name + ": there is no such column") +
            "; the columns are " + list_of(names)});
  }
  std::string unit = column.unit;
  if (unit.empty()) unit = split_name(expected.quantity, names[*index]).unit;
  const auto size = unit.empty() ? 1.0 : unit_size(expected.quantity, unit);
  if (!size) {
    return tl::unexpected(
        Problem{0, option + "-unit " + unit + ": must be one of " + units_of(expected.quantity)});
  }
  return Found{*index, *size * column.scale, std::string(names[*index])};
}

class CsvReader {
 public:
  CsvReader(std::string_view text, const Columns& columns) : lines_(text), columns_(columns) {}

  tl::expected<Recording, Problem> read() {
    if (!lines_.next()) return tl::unexpected(Problem{0, "is empty"});
    if (auto found = read_names(); !found) return tl::unexpected(found.error());
    while (lines_.next())
      if (auto added = add_row(); !added) return tl::unexpected(added.error());
    return std::move(recording_);
  }

 private:
  tl::expected<void, Problem> read_names() {
    const Fields& fields = lines_.fields();
    names_ = fields.size();
    if (lines_.number_in(fields.front())) {
      return tl::unexpected(Problem{lines_.number(),
                                    "begins with numbers: its first line must name the "
                                    "columns, e.g. time_s,position_m,power_W"});
    }
    const std::array<const ColumnNames*, 3> expected{&time_names, &position_names, &power_names};
    const std::array<const Column*, 3> columns{&columns_.time, &columns_.position, &columns_.power};
    for (std::size_t i = 0; i < 3; ++i) {
      auto found = find_column(fields, lines_.number(), *expected[i], *columns[i]);
      if (!found) return tl::unexpected(found.error());
      found_[i] = *found;
    }
    if (auto alone = check_one_heater(); !alone) return alone;
    const auto channel = std::find(fields.begin(), fields.end(), "channel");
    if (channel != fields.end()) channel_at_ = static_cast<std::size_t>(channel - fields.begin());
    if (columns_.channel != 0 && !channel_at_) {
      return tl::unexpected(
          Problem{lines_.number(), "has no column named channel: leave out --channel"});
    }
    return {};
  }

  /// A simulated joint's trace has the position that two heaters move.
  tl::expected<void, Problem> check_one_heater() const {
    constexpr std::string_view other = "antagonist_applied_power_W";
    const Fields& fields = lines_.fields();
    if (!columns_.power.name.empty() ||
        std::find(fields.begin(), fields.end(), other) == fields.end())
      return {};
    const std::string& power = found_[2].name;
    return tl::unexpected(
        Problem{lines_.number(), "is of a joint: two heaters move it, by " + power + " and " +
                                     std::string(other) +
                                     ", and only one would be fitted. Record each muscle alone; "
                                     "--power-column " +
                                     power + " fits that one all the same"});
  }

  tl::expected<void, Problem> add_row() {
    const Fields& fields = lines_.fields();
    if (fields.size() != names_) {
      return tl::unexpected(Problem{lines_.number(), "has " + std::to_string(fields.size()) +
                                                         " fields; there are " +
                                                         std::to_string(names_) + " columns"});
    }
    if (channel_at_ && columns_.channel == 0) {
      if (first_channel_.empty()) first_channel_ = fields[*channel_at_];
      if (fields[*channel_at_] != first_channel_) {
        return tl::unexpected(
            Problem{lines_.number(), "belongs to another channel: choose one with --channel"});
      }
    } else if (channel_at_ && fields[*channel_at_] != std::to_string(columns_.channel)) {
      return {};
    }
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view field = fields[found_[i].index];
      const auto value = lines_.number_in(field);
      if (!value) {
        return tl::unexpected(Problem{
            lines_.number(), found_[i].name + ": \"" + std::string(field) + "\" is not a number"});
      }
      if (i != 1 && std::isnan(*value)) {
        return tl::unexpected(
            Problem{lines_.number(), found_[i].name + (field.empty() ? " is missing" : " is NaN")});
      }
      values[i] = *value * found_[i].size;
    }
    recording_.time_s.push_back(values[0]);
    recording_.position_m.push_back(values[1]);
    recording_.power_W.push_back(values[2]);
    recording_.line.push_back(lines_.number());
    return {};
  }

  CsvLines lines_;
  const Columns& columns_;
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
