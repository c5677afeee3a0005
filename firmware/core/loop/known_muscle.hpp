// The muscle that a channel knows and that of the board's file, as other threads may read them.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "board/learned.hpp"
#include "loop/settings.hpp"

namespace supercoil {

/// In the order of Muscle.quantity in the DBC. Deviations and unexplained_ratio are NaN until
/// identify has found the muscle in use.
inline constexpr std::array<std::string_view, 44> known_quantities{
    "thermal_mass_J_per_K", "heat_transfer_W_per_K", "stiffness_N_per_m", "damping_Ns_per_m",
    "moving_mass_kg", "force_per_kelvin_N_per_K", "cold_resistance_Ohm", "position_offset_m",
    "position_scale",
    "response_ratio",  ///< of small motions; 0: not measured
    "theta1_deviation_ratio", "theta2_deviation_ratio", "theta3_deviation_ratio",
    "theta4_deviation_ratio",
    "unexplained_ratio",  ///< of the power's variance, left by the fit
    // From the board's file, whatever was found since.
    "configured_thermal_mass_J_per_K", "configured_heat_transfer_W_per_K",
    "configured_stiffness_N_per_m", "configured_damping_Ns_per_m", "configured_moving_mass_kg",
    "configured_force_per_kelvin_N_per_K", "configured_cold_resistance_Ohm",
    "joint_lever_m",            ///< at angle 0; negative for the antagonist; NaN: no joint
    "joint_other_node_offset",  ///< the other muscle's node minus this one's
    // control::Lever's values if it depends on the angle; NaN for those that it does not have.
    "joint_lever_first_rad", "joint_lever_last_rad", "joint_lever_1_m", "joint_lever_2_m",
    "joint_lever_3_m", "joint_lever_4_m", "joint_lever_5_m", "joint_lever_6_m", "joint_lever_7_m",
    "bundle_leader_node_offset",  ///< leader's node minus this one; NaN: it leads, or no bundle
    // Limits of a commanded position.
    "min_set_point_m", "max_set_point_m",
    "identified_s",  ///< since 1970; NaN: found since the start, or not known
    // Also from the board's file: its limits, and the bounds of [thermal].
    "configured_max_W", "configured_trip_C", "configured_min_mass_J_per_K",
    "configured_max_mass_J_per_K", "configured_min_transfer_W_per_K",
    "configured_max_transfer_W_per_K", "configured_max_time_constant_s"};
/// Places of the quantities after the six physical parameters.
enum KnownPlace : std::uint8_t {
  known_cold_resistance = 6,
  known_position_offset,
  known_position_scale,
  known_response_ratio,
  known_theta1_deviation,
  known_unexplained_ratio = 14,
  known_configured,  ///< the first configured quantity
  known_configured_resistance = 21,
  known_joint_lever,
  known_joint_other_node_offset,
  known_lever_first,
  known_lever_last,
  known_lever_points,  ///< the first of control::Lever::max_points
  known_bundle_leader_node_offset = known_lever_points + control::Lever::max_points,
  known_min_set_point,
  known_max_set_point,
  known_identified,
  known_configured_limits,                                ///< the first of two
  known_configured_bounds = known_configured_limits + 2,  ///< the first of five
};
/// A value for each of known_quantities, in their order; NaN: not known.
using KnownMuscle = std::array<double, known_quantities.size()>;

/// From the board's file; the set points also account for its joint.
struct ConfiguredMuscle {
  control::PhysicalParameters muscle;
  double cold_resistance_Ohm;
  PlaceInJoint joint;
  PlaceInBundle bundle{};
  double min_set_point_m = NAN;
  double max_set_point_m = NAN;
  double max_W = NAN;
  double trip_C = NAN;
  control::ThermalBounds bounds{};
};
/// min_set_point_m: in a joint it follows from the antagonist's limits.
inline ConfiguredMuscle configured_muscle(const ChannelSettings& c, double min_set_point_m) {
  return {c.file_muscle(), c.heater.cold_resistance_Ohm, c.joint,         c.bundle,
          min_set_point_m, c.supervision.max_travel_m,   c.limiter.max_W, c.supervision.trip_C,
          c.thermal.bounds};
}

/// Writes the joint's lever, or NaN for a muscle that turns no joint.
inline void set_lever(const PlaceInJoint& joint, KnownMuscle& known) {
  const control::Lever& lever = joint.lever;
  std::fill(known.begin() + known_lever_first, known.begin() + known_bundle_leader_node_offset,
            NAN);
  if (joint.direction == 0) return;
  known[known_joint_lever] = joint.direction * lever.zero_radius_m();
  if (lever.is_constant()) return;
  known[known_lever_first] = lever.first_rad();
  known[known_lever_last] = lever.last_rad();
  std::ranges::copy(lever.radii_m(), known.begin() + known_lever_points);
}

/// Inverts set_lever(), also for invalid values; direction 0: the muscle turns no joint.
inline PlaceInJoint joint_from(const KnownMuscle& known) {
  PlaceInJoint joint;
  const double lever_m = known[known_joint_lever];
  if (!(std::abs(lever_m) > 0.0)) return joint;
  joint.direction = lever_m > 0.0 ? 1 : -1;
  joint.other_channel_offset = known[known_joint_other_node_offset];
  const auto* const first = known.data() + known_lever_points;
  const auto* const end = known.data() + known_bundle_leader_node_offset;
  const auto* const last = std::find_if(
      first, end, [](double radius_m) { return !(radius_m > 0.0 && std::isfinite(radius_m)); });
  const double first_rad = known[known_lever_first];
  const double last_rad = known[known_lever_last];
  const bool table = last - first > 1 && first_rad <= 0.0 && last_rad >= 0.0 &&
                     last_rad > first_rad && std::isfinite(last_rad - first_rad);
  joint.lever = table ? control::Lever(first_rad, last_rad, {first, last})
                      : control::Lever(std::abs(lever_m));
  return joint;
}

/// m and c: in use now. Deviations, an unexplained_ratio or a date of 0 are not known: NaN.
inline KnownMuscle known_muscle(const control::PhysicalParameters& m, const board::Calibration& c,
                                double response_ratio, double unexplained_ratio,
                                const board::Identification& identification,
                                const ConfiguredMuscle& configured) {
  const control::PhysicalParameters& file = configured.muscle;
  const auto positive_or_nan = [](double value) { return value > 0.0 ? value : NAN; };
  KnownMuscle known{m.thermal_mass_J_per_K,
                    m.heat_transfer_W_per_K,
                    m.stiffness_N_per_m,
                    m.damping_Ns_per_m,
                    m.moving_mass_kg,
                    m.force_per_kelvin_N_per_K,
                    c.cold_resistance_Ohm,
                    c.position_offset_m,
                    c.position_scale,
                    response_ratio,
                    positive_or_nan(identification.deviation_ratio[0]),
                    positive_or_nan(identification.deviation_ratio[1]),
                    positive_or_nan(identification.deviation_ratio[2]),
                    positive_or_nan(identification.deviation_ratio[3]),
                    positive_or_nan(unexplained_ratio),
                    file.thermal_mass_J_per_K,
                    file.heat_transfer_W_per_K,
                    file.stiffness_N_per_m,
                    file.damping_Ns_per_m,
                    file.moving_mass_kg,
                    file.force_per_kelvin_N_per_K,
                    configured.cold_resistance_Ohm,
                    NAN,
                    configured.joint.other_channel_offset};
  set_lever(configured.joint, known);
  known[known_bundle_leader_node_offset] = configured.bundle.leader_offset;
  known[known_min_set_point] = configured.min_set_point_m;
  known[known_max_set_point] = configured.max_set_point_m;
  known[known_identified] = positive_or_nan(identification.identified_s);
  const control::ThermalBounds& b = configured.bounds;
  const double slowest_s = std::isfinite(b.max_time_constant_s) ? b.max_time_constant_s : NAN;
  const std::array limits{configured.max_W,   configured.trip_C,      b.min_mass_J_per_K,
                          b.max_mass_J_per_K, b.min_transfer_W_per_K, b.max_transfer_W_per_K,
                          slowest_s};
  static_assert(known_configured_limits + limits.size() == std::tuple_size_v<KnownMuscle>);
  std::ranges::copy(limits, known.begin() + known_configured_limits);
  return known;
}

/// From the loop to other threads. Each quantity is consistent by itself; together they may be from
/// two different moments.
class PublishedMuscle {
 public:
  /// In the loop's thread.
  void set(const KnownMuscle& known) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i].store(known[i], std::memory_order_relaxed);
  }
  /// quantity: place in known_quantities. NaN: not known, or no such quantity.
  double get(std::size_t quantity) const {
    return quantity < values_.size() ? values_[quantity].load(std::memory_order_relaxed) : NAN;
  }

 private:
  std::array<std::atomic<double>, known_quantities.size()> values_{};
};

}  // namespace supercoil
