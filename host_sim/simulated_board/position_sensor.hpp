// The converter that measures where the muscle is.
#pragma once

#include <cstdint>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

namespace supercoil::host_sim {

struct PositionSensorSettings {
  double noise_rms_m = 10e-6;
  int resolution_bits = 16;  ///< 0: not quantised
  double range_m = 0.040;    ///< readings are from 0 to this

  friend bool operator==(const PositionSensorSettings&, const PositionSensorSettings&) = default;
};

/// Adds white noise, rounds to the converter's steps and clips to its range. Boost.Random gives the
/// same noise for the same seed on every platform.
class PositionSensor {
 public:
  PositionSensor(const PositionSensorSettings& settings, std::uint64_t seed);

  double measure(double position_m);
  /// The noise goes on from where it was.
  void set(const PositionSensorSettings& settings);

 private:
  PositionSensorSettings settings_;
  double counts_per_m_ = 0.0;
  double m_per_count_ = 0.0;
  boost::random::mt19937_64 generator_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace supercoil::host_sim
