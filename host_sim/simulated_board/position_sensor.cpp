#include "simulated_board/position_sensor.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

PositionSensor::PositionSensor(const PositionSensorSettings& settings, std::uint64_t seed)
    : generator_(seed) {
  set(settings);
}

void PositionSensor::set(const PositionSensorSettings& settings) {
  settings_ = settings;
  const double counts = std::ldexp(1.0, settings.resolution_bits) - 1.0;
  counts_per_m_ = settings.resolution_bits > 0 ? counts / settings.range_m : 0.0;
  m_per_count_ = settings.resolution_bits > 0 ? settings.range_m / counts : 0.0;
}

double PositionSensor::measure(double position_m) {
  double reading = position_m;
  if (settings_.noise_rms_m > 0.0) reading += settings_.noise_rms_m * normal_(generator_);
  reading = std::clamp(reading, 0.0, settings_.range_m);
  if (counts_per_m_ > 0.0) reading = std::nearbyint(reading * counts_per_m_) * m_per_count_;
  return reading;
}

}  // namespace supercoil::host_sim
