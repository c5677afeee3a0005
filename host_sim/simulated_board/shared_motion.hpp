// What moves the muscles of several channels at once.
#pragma once

#include <cstddef>

namespace supercoil::host_sim {

/// As each of the channels sees it. muscle: its place among them, from 0.
class SharedMotion {
 public:
  SharedMotion(const SharedMotion&) = delete;
  SharedMotion& operator=(const SharedMotion&) = delete;

  /// How far the muscle has contracted.
  virtual double position_m(std::size_t muscle) const = 0;
  /// What a position sensor of the muscle's channel sees.
  virtual double reading_m(std::size_t muscle) const { return position_m(muscle); }
  virtual double temperature_rise_K(std::size_t muscle) const = 0;
  virtual double peak_temperature_rise_K(std::size_t muscle) const = 0;

 protected:
  SharedMotion() = default;
  ~SharedMotion() = default;
};

}  // namespace supercoil::host_sim
