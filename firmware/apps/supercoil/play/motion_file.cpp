#include "apps/supercoil/play/motion_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "can/nodes.hpp"

namespace supercoil::operating {

namespace {

using MotionRow = std::vector<double>;
/// Places of columns; none: the file lacks it.
struct Columns {
  std::optional<std::size_t> position;
  std::optional<std::size_t> velocity;
};

/// Of Knot.after_s, whose largest value means something else.
constexpr double max_row_step_s = 4.094;
constexpr double min_row_step_s = 0.001;
constexpr double max_velocity = 0.32767;

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    const auto begin = cell.find_first_not_of(" \t\r");
    const auto end = cell.find_last_not_of(" \t\r");
    cells.push_back(begin == std::string_view::npos ? "" : cell.substr(begin, end - begin + 1));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Lines of a text, their numbers from 1; empty ones are left out.
class FullLines {
 public:
  explicit FullLines(const std::string& text) : stream_(text) {}
  bool next() {
    while (std::getline(stream_, line_)) {
      ++number_;
      if (line_.find_first_not_of(" \t\r") != std::string::npos) return true;
    }
    return false;
  }
  const std::string& line() const { return line_; }
  int number() const { return number_; }

 private:
  std::istringstream stream_;
  std::string line_;
  int number_ = 0;
};

class MotionReader {
 public:
  MotionReader(const std::string& text, std::string name, std::uint8_t node)
      : lines_(text), name_(std::move(name)), node_(node) {}

  tl::expected<std::vector<Motion>, std::string> read() {
    if (!lines_.next()) return tl::unexpected(name_ + ": is empty");
    if (auto problem = read_head()) return tl::unexpected(*problem);
    while (lines_.next()) {
      if (auto problem = read_row()) return tl::unexpected(*problem);
    }
    if (rows_.size() < 2) return tl::unexpected(name_ + ": has fewer than 2 rows");
    std::vector<Motion> motions;
    for (const auto& [node, columns] : columns_) {
      motions.push_back({node, knots_of(columns)});
      if (auto problem = check(motions.back())) return tl::unexpected(*problem);
    }
    return motions;
  }

 private:
  std::string at_line(const std::string& what) const {
    return name_ + ":" + std::to_string(lines_.number()) + ": " + what;
  }

  std::optional<std::string> read_head() {
    const auto names = cells_of(lines_.line());
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == "time_s") {
        time_ = i;
      } else if (auto problem = read_name(names[i], i)) {
        return problem;
      }
    }
    if (!time_) return at_line("has no column time_s");
    for (const auto& [node, columns] : columns_) {
      if (!columns.position) return at_line("has no position_m of node " + std::to_string(node));
    }
    if (columns_.empty()) return at_line("has no column position_m");
    cells_ = names.size();
    return std::nullopt;
  }

  std::optional<std::string> read_name(std::string_view name, std::size_t place) {
    const std::size_t colon = name.find(':');
    const bool numbered = colon != std::string_view::npos;
    const auto node = numbered ? number_in<int>(name.substr(0, colon)) : int{node_};
    if (!node || *node < 1 || *node > can::max_nodes) {
      return at_line("'" + std::string(name) + "': a node is 1 to " +
                     std::to_string(can::max_nodes));
    }
    const std::string_view what = numbered ? name.substr(colon + 1) : name;
    Columns& columns = columns_[static_cast<std::uint8_t>(*node)];
    auto* column = what == "position_m"         ? &columns.position
                   : what == "velocity_m_per_s" ? &columns.velocity
                                                : nullptr;
    if (column == nullptr) {
      return at_line("'" + std::string(name) +
                     "' is no column; there are time_s, position_m, velocity_m_per_s, and for "
                     "several nodes 2:position_m and so on");
    }
    if (*column) return at_line("has '" + std::string(name) + "' twice");
    *column = place;
    return std::nullopt;
  }

  std::optional<std::string> read_row() {
    const auto cells = cells_of(lines_.line());
    if (cells.size() != cells_) {
      return at_line("has " + std::to_string(cells.size()) + " columns, the first line " +
                     std::to_string(cells_));
    }
    MotionRow row;
    for (const std::string_view cell : cells) {
      const auto number = number_in<double>(cell);
      if (!number || !std::isfinite(*number))
        return at_line("'" + std::string(cell) + "' is not a number");
      row.push_back(*number);
    }
    double& time_s = row[*time_];
    if (rows_.empty()) begins_s_ = time_s;
    // What the bus's milliseconds leave of it.
    time_s = std::round((time_s - begins_s_) * 1e3) / 1e3;
    const double step_s = rows_.empty() ? min_row_step_s : time_s - rows_.back()[*time_];
    if (!(step_s > min_row_step_s / 2.0 && step_s < max_row_step_s + min_row_step_s / 2.0)) {
      return at_line("time_s is " + std::to_string(step_s) +
                     " s after the row before; it must be 0.001 to 4.094 s");
    }
    rows_.push_back(std::move(row));
    return std::nullopt;
  }

  std::vector<control::Knot> knots_of(const Columns& columns) const {
    std::vector<control::Knot> knots;
    for (const MotionRow& row : rows_) {
      knots.push_back(
          {row[*time_], row[*columns.position], columns.velocity ? row[*columns.velocity] : 0.0});
    }
    if (columns.velocity) return knots;
    for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
      const double before_s = knots[i].time_s - knots[i - 1].time_s;
      const double after_s = knots[i + 1].time_s - knots[i].time_s;
      const double before = (knots[i].position_m - knots[i - 1].position_m) / before_s;
      const double after = (knots[i + 1].position_m - knots[i].position_m) / after_s;
      knots[i].velocity_m_per_s = (before * after_s + after * before_s) / (before_s + after_s);
    }
    return knots;
  }

  std::optional<std::string> check(const Motion& motion) const {
    const std::string whose = name_ + ": node " + std::to_string(motion.node) + ": ";
    for (const auto& [which, knot] :
         {std::pair{"first", motion.knots.front()}, std::pair{"last", motion.knots.back()}}) {
      if (knot.velocity_m_per_s != 0.0)
        return whose + "velocity_m_per_s of the " + which + " row must be 0";
    }
    const auto fast = std::ranges::find_if(motion.knots, [](const control::Knot& knot) {
      return std::abs(knot.velocity_m_per_s) > max_velocity;
    });
    if (fast == motion.knots.end()) return std::nullopt;
    return whose + "at " + std::to_string(fast->time_s) + " s it moves by " +
           std::to_string(fast->velocity_m_per_s) + " m/s; at most 0.32767 can be sent";
  }

  FullLines lines_;
  std::string name_;
  std::uint8_t node_;
  std::optional<std::size_t> time_;
  std::map<std::uint8_t, Columns> columns_;
  std::size_t cells_ = 0;
  std::vector<MotionRow> rows_;
  double begins_s_ = 0.0;
};

}  // namespace

tl::expected<std::vector<Motion>, std::string> parse_motions(const std::string& text,
                                                             const std::string& name,
                                                             std::uint8_t node) {
  return MotionReader(text, name, node).read();
}

tl::expected<std::vector<Motion>, std::string> read_motions(const std::string& path,
                                                            std::uint8_t node) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) return tl::unexpected(path + ": cannot be read");
  return parse_motions(text.str(), path, node);
}

}  // namespace supercoil::operating
