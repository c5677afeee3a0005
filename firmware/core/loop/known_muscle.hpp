// What a channel goes by, and what its file says of it, as other threads may ask for it.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "board/learned.hpp"
#include "loop/settings.hpp"
#include "modes/identify.hpp"

namespace supercoil {

/// In the order of Muscle.quantity in the DBC. What identify told of its own result is NaN until it
/// has found a muscle since the start.
inline constexpr std::array<std::string_view, 24> known_quantities{
    "thermal_mass_J_per_K", "heat_transfer_W_per_K", "stiffness_N_per_m", "damping_Ns_per_m",
    "moving_mass_kg", "force_per_kelvin_N_per_K", "cold_resistance_Ohm", "position_offset_m",
    "position_scale",
    "response_ratio",  ///< of small motions; 0: not measured
    "theta1_deviation_ratio", "theta2_deviation_ratio", "theta3_deviation_ratio",
    "theta4_deviation_ratio",
    "unexplained_ratio",  ///< of the power's variance, by the fit
    // By the board's file, whatever was found since.
    "configured_thermal_mass_J_per_K", "configured_heat_transfer_W_per_K",
    "configured_stiffness_N_per_m", "configured_damping_Ns_per_m", "configured_moving_mass_kg",
    "configured_force_per_kelvin_N_per_K", "configured_cold_resistance_Ohm",
    "joint_lever_m",  ///< < 0 of the antagonist: the angle is position / lever; NaN: no joint
    "joint_other_node_offset"};  ///< of the other muscle, minus this one's
/// Places of those that follow the six physical parameters.
enum KnownPlace : std::uint8_t {
  known_cold_resistance = 6,
  known_position_offset,
  known_position_scale,
  known_response_ratio,
  known_theta1_deviation,
  known_unexplained_ratio = 14,
  known_configured,  ///< the first of the configured ones
  known_joint_lever = 22,
  known_joint_other_node_offset,
};
using KnownMuscle = std::array<double, known_quantities.size()>;

/// What a board's file says.
struct ConfiguredMuscle {
  control::PhysicalParameters muscle;
  double cold_resistance_Ohm;
  PlaceInJoint joint;
};

inline KnownMuscle known_muscle(const control::PhysicalParameters& m, const board::Calibration& c,
                                double response_ratio, const modes::Identify::Quality& q,
                                const ConfiguredMuscle& configured) {
  const control::PhysicalParameters& file = configured.muscle;
  return {m.thermal_mass_J_per_K,
          m.heat_transfer_W_per_K,
          m.stiffness_N_per_m,
          m.damping_Ns_per_m,
          m.moving_mass_kg,
          m.force_per_kelvin_N_per_K,
          c.cold_resistance_Ohm,
          c.position_offset_m,
          c.position_scale,
          response_ratio,
          q.deviation_ratio[0],
          q.deviation_ratio[1],
          q.deviation_ratio[2],
          q.deviation_ratio[3],
          q.unexplained_ratio,
          file.thermal_mass_J_per_K,
          file.heat_transfer_W_per_K,
          file.stiffness_N_per_m,
          file.damping_Ns_per_m,
          file.moving_mass_kg,
          file.force_per_kelvin_N_per_K,
          configured.cold_resistance_Ohm,
          configured.joint.lever_m,
          configured.joint.other_channel_offset};
}

/// From the loop to other threads; each quantity is whole, all of them together may be of two
/// moments.
class PublishedMuscle {
 public:
  void set(const KnownMuscle& known) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i].store(known[i], std::memory_order_relaxed);
  }
  /// quantity: place in known_quantities. NaN: not known, or there is none.
  double get(std::size_t quantity) const {
    return quantity < values_.size() ? values_[quantity].load(std::memory_order_relaxed) : NAN;
  }

 private:
  std::array<std::atomic<double>, known_quantities.size()> values_{};
};

}  // namespace supercoil
