#include "apps/supercoil/play/motion_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "supercoil/identification/csv.hpp"

#include "apps/supercoil/user_file.hpp"
#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

using MotionRow = std::vector<double>;
/// Column positions; empty: the file lacks that column.
struct Columns {
  std::optional<std::size_t> position;
  std::optional<std::size_t> velocity;
};

/// The largest value that a knot can carry.
double max_value(can::SignalOf<can::message::knot> signal) {
  hal::CanFrame frame;
  can::put(frame, signal.info(), INFINITY);
  return can::get(frame, signal.info());
}
/// A knot's times are whole milliseconds.
constexpr double min_row_step_s = 0.001;

class MotionReader {
 public:
  /// text outlives it.
  MotionReader(std::string_view text, std::string name, std::uint8_t node)
      : lines_(text), name_(std::move(name)), node_(node) {}

  Result<std::vector<Motion>> read() {
    if (!lines_.next()) return failure(name_ + ": is empty");
    if (auto problem = read_head()) return failure(*problem);
    while (lines_.next()) {
      if (auto problem = read_row()) return failure(*problem);
    }
    if (rows_.size() < 2) return failure(name_ + ": has fewer than 2 rows");
    std::vector<Motion> motions;
    for (const auto& [node, columns] : columns_) {
      motions.push_back({node, knots_of(columns)});
      if (auto problem = check(motions.back())) return failure(*problem);
    }
    return motions;
  }

 private:
  std::string at_line(const std::string& what) const {
    return name_ + ":" + std::to_string(lines_.number()) + ": " + what;
  }

  std::optional<std::string> read_head() {
    const auto& names = lines_.fields();
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
    columns_of_file_ = names.size();
    return std::nullopt;
  }

  std::optional<std::string> read_name(std::string_view name, std::size_t place) {
    const std::size_t colon = name.find(':');
    const bool numbered = colon != std::string_view::npos;
    int node = numbered ? 0 : node_;
    const bool whole = !numbered || std::from_chars(name.data(), name.data() + colon, node).ptr ==
                                        name.data() + colon;
    if (!whole || node < 1 || node > can::max_nodes) {
      return at_line("'" + std::string(name) + "': a node must be 1 to " +
                     std::to_string(can::max_nodes));
    }
    const std::string_view what = numbered ? name.substr(colon + 1) : name;
    Columns& columns = columns_[static_cast<std::uint8_t>(node)];
    auto* column = what == "position_m"         ? &columns.position
                   : what == "velocity_m_per_s" ? &columns.velocity
                                                : nullptr;
    if (column == nullptr) {
      return at_line("'" + std::string(name) +
                     "' is not a known column; expected time_s, position_m, velocity_m_per_s, and "
                     "for several nodes 2:position_m and so on");
    }
    if (*column) return at_line("has '" + std::string(name) + "' twice");
    *column = place;
    return std::nullopt;
  }

  std::optional<std::string> read_row() {
    const auto& fields = lines_.fields();
    if (fields.size() != columns_of_file_) {
      return at_line("has " + std::to_string(fields.size()) + " fields; there are " +
                     std::to_string(columns_of_file_) + " columns");
    }
    MotionRow row;
    for (const std::string_view field : fields) {
      const auto number = lines_.number_in(field);
      if (!number || !std::isfinite(*number))
        return at_line("\"" + std::string(field) + "\" is not a number");
      row.push_back(*number);
    }
    double& time_s = row[*time_];
    if (rows_.empty()) begins_s_ = time_s;
    const double written_step_s = rows_.empty() ? min_row_step_s : time_s - written_s_;
    written_s_ = time_s;
    // Round to the bus's milliseconds.
    time_s = std::round((time_s - begins_s_) * 1e3) / 1e3;
    const double step_s = rows_.empty() ? min_row_step_s : time_s - rows_.back()[*time_];
    const double max_row_step_s = max_value("after_s");
    if (!(std::min(step_s, written_step_s) > 0.5 * min_row_step_s &&
          step_s < max_row_step_s + 0.5 * min_row_step_s)) {
      return at_line("time_s is " + number_text(written_step_s, 7) +
                     " s after the row before; it must be " + shortest_text(min_row_step_s) +
                     " to " + shortest_text(max_row_step_s) + " s");
    }
    rows_.push_back(std::move(row));
    row_lines_.push_back(lines_.number());
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
    const auto at_row = [&](std::size_t row, const std::string& what) {
      return name_ + ":" + std::to_string(row_lines_[row]) + ": node " +
             std::to_string(motion.node) + ": " + what;
    };
    for (const auto& [which, row] :
         {std::pair{"first", std::size_t{0}}, std::pair{"last", motion.knots.size() - 1}}) {
      if (motion.knots[row].velocity_m_per_s != 0.0)
        return at_row(row, std::string("velocity_m_per_s of the ") + which + " row must be 0");
    }
    const double max_velocity = max_value("velocity_m_per_s");
    const auto fast = std::ranges::find_if(motion.knots, [&](const control::Knot& knot) {
      return std::abs(knot.velocity_m_per_s) > max_velocity;
    });
    if (fast == motion.knots.end()) return std::nullopt;
    return at_row(static_cast<std::size_t>(fast - motion.knots.begin()),
                  "at " + shortest_text(fast->time_s) + " s it moves by " +
                      number_text(fast->velocity_m_per_s, 7) + " m/s; at most " +
                      shortest_text(max_velocity) + " can be sent");
  }

  identification::CsvLines lines_;
  std::string name_;
  std::uint8_t node_;
  std::optional<std::size_t> time_;
  std::map<std::uint8_t, Columns> columns_;
  std::size_t columns_of_file_ = 0;
  std::vector<MotionRow> rows_;
  std::vector<std::size_t> row_lines_;
  double begins_s_ = 0.0;
  double written_s_ = 0.0;  ///< time of the last row, not rounded
};

}  // namespace

Result<std::vector<Motion>> read_motions(const std::string& path, std::uint8_t node) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return MotionReader(*text, path, node).read();
}

}  // namespace supercoil::operating
