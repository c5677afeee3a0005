// How far the muscles of a joint contract when it turns.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace supercoil::control {

/// The radius at which a muscle pulls: constant, or dependent on the joint's angle. The muscle
/// contracts by the arc, ∫ r dθ from the angle 0.
class Lever {
 public:
  static constexpr std::size_t max_points = 7;

  /// Constant, 15 mm.
  Lever() : Lever(0.015) {}
  /// radius_m > 0.
  explicit Lever(double radius_m) : radii_m_{radius_m} {}

  /// radii_m: 2 to max_points, each > 0, at evenly spaced angles from first_rad <= 0 to
  /// last_rad >= 0; linear between two points, and constant beyond.
  Lever(double first_rad, double last_rad, std::span<const double> radii_m)
      : first_rad_(first_rad),
        spacing_rad_((last_rad - first_rad) / static_cast<double>(radii_m.size() - 1)),
        points_(radii_m.size()) {
    std::ranges::copy(radii_m, radii_m_.begin());
    for (std::size_t i = 1; i < points_; ++i)
      arcs_m_[i] = arcs_m_[i - 1] + 0.5 * (radii_m_[i - 1] + radii_m_[i]) * spacing_rad_;
    const double zero_m = arc_m(0.0);
    for (std::size_t i = 0; i < points_; ++i)
      arcs_m_[i] -= zero_m;
  }

  /// The lever with all radii multiplied by ratio > 0.
  Lever scaled(double ratio) const {
    Lever other = *this;
    for (std::size_t i = 0; i < points_; ++i) {
      other.radii_m_[i] *= ratio;
      other.arcs_m_[i] *= ratio;
    }
    return other;
  }

  bool is_constant() const { return points_ == 1; }
  /// The radii that the lever was constructed from.
  std::span<const double> radii_m() const { return {radii_m_.data(), points_}; }
  double first_rad() const { return first_rad_; }
  double last_rad() const { return first_rad_ + static_cast<double>(points_ - 1) * spacing_rad_; }
  double min_radius_m() const { return *std::ranges::min_element(radii_m()); }
  double max_radius_m() const { return *std::ranges::max_element(radii_m()); }

  /// In m, at an angle in rad. A NaN argument gives NaN, here and below.
  double radius_m(double angle_rad) const {
    const double in_rad = std::clamp(angle_rad, first_rad_, last_rad());
    const std::size_t i = before(in_rad);
    return radii_m_[i] + slope_m_per_rad(i) * (in_rad - angle_of(i));
  }
  double zero_radius_m() const { return radius_m(0.0); }

  /// The contraction of the agonist from the angle 0 to this one: in m, for an angle in rad.
  double arc_m(double angle_rad) const {
    const double in_rad = std::clamp(angle_rad, first_rad_, last_rad());
    const std::size_t i = before(in_rad);
    const double turned_rad = in_rad - angle_of(i);
    return arcs_m_[i] + (radii_m_[i] + 0.5 * slope_m_per_rad(i) * turned_rad) * turned_rad +
           radius_m(in_rad) * (angle_rad - in_rad);
  }

  /// The angle in rad at which arc_m() is this arc, in m.
  double angle_rad(double arc_m) const {
    std::size_t i = 0;
    while (i + 1 < points_ && arcs_m_[i + 1] < arc_m)
      ++i;
    const double left_m = arc_m - arcs_m_[i];
    // The radius is constant before the table's first point and after its last.
    const bool beyond = left_m < 0.0 || i + 1 == points_;
    const double slope = beyond ? 0.0 : slope_m_per_rad(i);
    const double radius_m = radii_m_[i];
    // The root that stays near left_m / radius_m when the slope vanishes.
    return angle_of(i) +
           2.0 * left_m / (radius_m + std::sqrt(radius_m * radius_m + 2.0 * slope * left_m));
  }

  bool operator==(const Lever&) const = default;

 private:
  double angle_of(std::size_t point) const {
    return first_rad_ + static_cast<double>(point) * spacing_rad_;
  }
  /// The last point before an angle within the table.
  std::size_t before(double in_rad) const {
    if (points_ < 3) return 0;
    const double place = (in_rad - first_rad_) / spacing_rad_;
    if (!(place > 0.0)) return 0;  // or it is NaN
    return std::min(static_cast<std::size_t>(place), points_ - 2);
  }
  double slope_m_per_rad(std::size_t point) const {
    return point + 1 < points_ ? (radii_m_[point + 1] - radii_m_[point]) / spacing_rad_ : 0.0;
  }

  double first_rad_ = 0.0;
  double spacing_rad_ = 0.0;
  std::size_t points_ = 1;
  std::array<double, max_points> radii_m_{};
  std::array<double, max_points> arcs_m_{};  ///< at the points
};

}  // namespace supercoil::control
