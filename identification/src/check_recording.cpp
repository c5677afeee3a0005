#include <algorithm>
#include <cmath>
#include <sstream>

#include "supercoil/identification/recording.hpp"
#include "supercoil/identification/units.hpp"

namespace supercoil::identification {

namespace {

constexpr std::size_t min_rows = 50;
/// A gap exceeds gap_intervals usual intervals. It is refused if it exceeds both refused_intervals
/// of them and refused_gap_s.
constexpr double gap_intervals = 3.0;
constexpr double refused_intervals = 10.0;
constexpr double refused_gap_s = 0.1;

template <class... Parts>
Problem problem(std::size_t line, const Parts&... parts) {
  std::ostringstream text;
  text.precision(4);
  (text << ... << parts);
  return {line, text.str()};
}

using Checked = tl::expected<void, Problem>;

template <class... Parts>
Checked refuse(std::size_t line, const Parts&... parts) {
  return tl::unexpected(problem(line, parts...));
}

double median_interval(const Recording& r) {
  std::vector<double> intervals(r.size() - 1);
  for (std::size_t i = 0; i + 1 < r.size(); ++i)
    intervals[i] = r.time_s[i + 1] - r.time_s[i];
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

Checked check_values(const Recording& r) {
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (std::isinf(r.time_s[i]) || std::isinf(r.position_m[i]) || !std::isfinite(r.power_W[i]))
      return refuse(r.line[i], "has an infinite value");
    if (r.power_W[i] < 0.0)
      return refuse(r.line[i], "power is ", r.power_W[i], " W: a muscle is heated, never cooled");
  }
  return {};
}

Checked check_times(Recording& r, Gaps gaps) {
  for (std::size_t i = 1; i < r.size(); ++i) {
    if (r.time_s[i] == r.time_s[i - 1]) {
      return refuse(r.line[i], "the time ", time_text(r.time_s[i]),
                    " s occurs twice, first in line ", r.line[i - 1]);
    }
    if (r.time_s[i] < r.time_s[i - 1]) {
      return refuse(r.line[i], "the time goes back, from ", time_text(r.time_s[i - 1]), " to ",
                    time_text(r.time_s[i]),
                    " s: rows must be in order of time and come from one recording");
    }
  }
  const double usual_s = median_interval(r);
  if (usual_s > 2.0 || usual_s < 2e-5) {
    return refuse(r.line[1], "rows are ", usual_s,
                  " s apart: is time in another unit (--time-unit)?");
  }
  std::size_t count = 0;
  std::size_t longest = 0;
  double max_s = 0.0;
  for (std::size_t i = 1; i < r.size(); ++i) {
    const double interval_s = r.time_s[i] - r.time_s[i - 1];
    if (interval_s <= gap_intervals * usual_s) continue;
    ++count;
    if (interval_s > max_s) {
      max_s = interval_s;
      longest = i;
    }
  }
  if (count == 0) return {};
  constexpr double rounding = 1.0 + 1e-6;  // 0.5 - 0.4 is more than 0.1
  if (gaps == Gaps::refuse &&
      max_s > rounding * std::max(refused_intervals * usual_s, refused_gap_s)) {
    return refuse(r.line[longest], "rows are missing: ", max_s, " s since the row before, ",
                  usual_s,
                  " s elsewhere. The power in the gap is not known: use a part without the gap "
                  "(--from, --to), or give --bridge-gaps if the power did not change");
  }
  r.warnings.push_back(problem(r.line[longest], "rows are missing in ", count,
                               " places, the longest gap being here: ", max_s,
                               " s; power is taken as unchanged"));
  return {};
}

Checked check_position(Recording& r) {
  std::size_t missing = 0;
  std::size_t first_missing = 0;
  std::size_t lowest = r.size();
  std::size_t highest = r.size();
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (std::isnan(r.position_m[i])) {
      if (missing++ == 0) first_missing = i;
      continue;
    }
    if (lowest == r.size() || r.position_m[i] < r.position_m[lowest]) lowest = i;
    if (highest == r.size() || r.position_m[i] > r.position_m[highest]) highest = i;
  }
  if (2 * missing > r.size()) {
    return refuse(r.line[first_missing], "position is missing in ", missing, " of ", r.size(),
                  " rows");
  }
  if (missing > 0) {
    r.warnings.push_back(problem(r.line[first_missing], "position is missing in ", missing, " of ",
                                 r.size(), " rows, first here; these rows are left out"));
  }
  const double stroke_m = r.position_m[highest] - r.position_m[lowest];
  if (stroke_m > 1.0) {
    return refuse(r.line[highest], "position moves by ", stroke_m,
                  " m, with its highest value here: is it in another unit (--position-unit)?");
  }
  if (stroke_m == 0.0) return refuse(r.line[0], "position never changes");
  if (stroke_m < 2e-6) {
    return refuse(r.line[highest], "position moves by ", stroke_m,
                  " m, with its highest value here: is it in another unit (--position-unit)?");
  }
  return {};
}

Checked check_power(const Recording& r) {
  const auto lowest = std::min_element(r.power_W.begin(), r.power_W.end());
  const auto highest = std::max_element(r.power_W.begin(), r.power_W.end());
  const std::size_t line = r.line[static_cast<std::size_t>(highest - r.power_W.begin())];
  if (*highest - *lowest <= 1e-3 * *highest) {
    return refuse(
        line, "power never changes from ", *highest,
        " W: its effect cannot be identified; is this the right column (--power-column)?");
  }
  if (*highest > 1000.0 || *highest < 1e-3) {
    return refuse(line, "power reaches ", *highest,
                  " W here: is it in another unit (--power-unit)?");
  }
  return {};
}

}  // namespace

tl::expected<void, Problem> check(Recording& recording, Gaps gaps) {
  if (recording.size() < min_rows)
    return refuse(0, "has ", recording.size(), " rows; a fit needs ", min_rows);
  if (auto checked = check_values(recording); !checked) return checked;
  if (auto checked = check_times(recording, gaps); !checked) return checked;
  if (auto checked = check_position(recording); !checked) return checked;
  return check_power(recording);
}

void cut(Recording& recording, Span span) {
  Recording kept;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    if (!span.holds(recording.time_s[i])) continue;
    kept.time_s.push_back(recording.time_s[i]);
    kept.position_m.push_back(recording.position_m[i]);
    kept.power_W.push_back(recording.power_W[i]);
    kept.line.push_back(recording.line[i]);
  }
  kept.warnings = std::move(recording.warnings);
  recording = std::move(kept);
}

}  // namespace supercoil::identification
