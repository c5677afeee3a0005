#include <algorithm>
#include <cmath>
#include <limits>

#include "supercoil/identification/recording.hpp"

namespace supercoil::identification {

namespace {

constexpr double target_step_s = 0.02;
constexpr double max_samples = 10000.0;
/// Positions further apart than this many steps are not interpolated.
constexpr double bridged_steps = 3.0;

/// The mean power from one time to another; `row`, the last row at or before from_s, advances.
double mean_power(const Recording& r, std::size_t& row, double from_s, double to_s) {
  while (row + 1 < r.size() && r.time_s[row + 1] <= from_s)
    ++row;
  double energy_J = 0.0;
  double at_s = from_s;
  for (std::size_t i = row; at_s < to_s; ++i) {
    const double until_s = i + 1 < r.size() ? std::min(r.time_s[i + 1], to_s) : to_s;
    energy_J += r.power_W[i] * (until_s - at_s);
    at_s = until_s;
  }
  return energy_J / (to_s - from_s);
}

/// A mean position, and the mean offset and mean square offset of its rows' times from the
/// sample's.
struct MeanPosition {
  double position_m = std::numeric_limits<double>::quiet_NaN();
  double offset_s = 0.0;
  double square_offset_s2 = 0.0;
};

/// The mean of the positions within half a step, or else a straight line between neighbours.
class Positions {
 public:
  explicit Positions(const Recording& recording) {
    for (std::size_t i = 0; i < recording.size(); ++i) {
      if (std::isnan(recording.position_m[i])) continue;
      time_s_.push_back(recording.time_s[i]);
      position_m_.push_back(recording.position_m[i]);
    }
  }

  MeanPosition at(double time_s, double step_s, bool averaged) {
    const double half = averaged ? half_window_s(time_s, step_s) : 0.0;
    const auto first = std::lower_bound(time_s_.begin(), time_s_.end(), time_s - half);
    MeanPosition sum{.position_m = 0.0};
    double count = 0.0;
    for (auto t = first; t != time_s_.end() && *t <= time_s + half; ++t, count += 1.0) {
      sum.position_m += position_m_[static_cast<std::size_t>(t - time_s_.begin())];
      sum.offset_s += *t - time_s;
      sum.square_offset_s2 += (*t - time_s) * (*t - time_s);
    }
    if (count > 0.0)
      return {sum.position_m / count, sum.offset_s / count, sum.square_offset_s2 / count};
    if (first == time_s_.begin() || first == time_s_.end()) return {};
    const auto i = static_cast<std::size_t>(first - time_s_.begin());
    const double apart_s = time_s_[i] - time_s_[i - 1];
    if (apart_s > bridged_steps * step_s) return {};
    const double share = (time_s - time_s_[i - 1]) / apart_s;
    return {position_m_[i - 1] + share * (position_m_[i] - position_m_[i - 1])};
  }

 private:
  /// Symmetric also where positions begin or end; rounding leaves out no row at one end only.
  double half_window_s(double time_s, double step_s) const {
    if (time_s_.empty()) return 0.0;
    const double room_s = std::min(time_s - time_s_.front(), time_s_.back() - time_s);
    return std::clamp(room_s, 0.0, 0.5 * step_s) + 1e-6 * step_s;
  }

  std::vector<double> time_s_;
  std::vector<double> position_m_;
};

/// The position at a sample's own time. The mean lacks the motion's curvature, which without this
/// would look like a quicker and more damped muscle.
double position_at_m(const std::vector<MeanPosition>& means, std::size_t k, double step_s) {
  const MeanPosition& mean = means[k];
  if (k == 0 || k + 1 == means.size()) return mean.position_m;
  const double before_m = means[k - 1].position_m;
  const double after_m = means[k + 1].position_m;
  const double velocity = (after_m - before_m) / (2.0 * step_s);
  const double acceleration = (after_m - 2.0 * mean.position_m + before_m) / (step_s * step_s);
  const double lacking_m = mean.offset_s * velocity + 0.5 * mean.square_offset_s2 * acceleration;
  return std::isnan(lacking_m) ? mean.position_m : mean.position_m - lacking_m;
}

}  // namespace

Samples resample(const Recording& r) {
  const double duration_s = r.time_s.back() - r.time_s.front();
  const double mean_interval_s = duration_s / static_cast<double>(r.size() - 1);
  const double desired_step_s = std::max(target_step_s, duration_s / max_samples);
  // Whole intervals, so that samples coincide with rows if the recording's rate is constant.
  const double intervals = std::max(1.0, std::round(desired_step_s / mean_interval_s));
  Samples samples;
  samples.start_s = r.time_s.front();
  samples.step_s = intervals * mean_interval_s;
  const auto count = static_cast<std::size_t>(duration_s / samples.step_s + 1e-6) + 1;
  Positions positions(r);
  std::vector<MeanPosition> means;
  for (std::size_t k = 0; k < count; ++k)
    means.push_back(positions.at(samples.time_s(k), samples.step_s, intervals > 1.5));
  std::size_t row = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double time_s = samples.time_s(k);
    samples.position_m.push_back(position_at_m(means, k, samples.step_s));
    samples.power_W.push_back(mean_power(r, row, time_s, time_s + samples.step_s));
  }
  return samples;
}

}  // namespace supercoil::identification
