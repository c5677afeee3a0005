// Friction in the load's guide.
#pragma once

#include "plant/effects.hpp"
#include "plant/mechanics.hpp"

namespace supercoil::host_sim {

/// LuGre: ż = v − |v| z/g(v), friction σ0 z + σ1 ż, σ0 g(v) = Fc + (Fs − Fc) exp(−(v/vs)²)
/// (Canudas de Wit et al., 1995).
class GuideFriction {
 public:
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects);
  bool on() const { return coulomb_N_ > 0.0; }
  /// Damping of the moving mass from now on, for a load whose damping changes.
  void set_viscous(double damping_Ns_per_m) { viscous_Ns_per_m_ = damping_Ns_per_m; }
  /// Moves the mass against spring, damper and friction. mechanics: its motion without friction.
  Motion step(const Motion& from, const Drive& drive, const Mechanics& mechanics);
  double friction_N(double velocity_m_per_s) const {
    return stiffness_N_per_m_ * bristle_m_ +
           damping_Ns_per_m_ * bristle_speed(bristle_m_, velocity_m_per_s);
  }
  double bristle_m() const { return bristle_m_; }

 private:
  struct State {
    double position_m;
    double velocity_m_per_s;
    double bristle_m;
  };
  double bristle_speed(double bristle_m, double velocity_m_per_s) const;
  /// For motion too fast to follow the bristles: constant friction; they yield along the path.
  Motion coarse_step(const Motion& from, const Drive& drive, const Mechanics& mechanics);
  State slope(const State& state, double stiffness_N_per_m, double force_N) const;

  double per_mass_ = 1.0;
  double viscous_Ns_per_m_ = 0.0;
  double coulomb_N_ = 0.0;
  double static_N_ = 0.0;
  double stiffness_N_per_m_ = 0.0;
  double damping_Ns_per_m_ = 0.0;
  double per_stribeck_ = 1.0;
  double bristle_m_ = 0.0;
};

}  // namespace supercoil::host_sim
