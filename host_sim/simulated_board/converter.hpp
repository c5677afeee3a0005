// A converter's input on the simulated board.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <boost/circular_buffer.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "supercoil/hal/adc_channel.hpp"

namespace supercoil::host_sim {

struct ConverterSettings {
  double low = 0.0;  ///< with high: values at 0 and full scale; readings are clipped to them
  double high = 1.0;
  int bits = 16;           ///< 0: practically not quantised
  double noise_rms = 0.0;  ///< white, in every conversion
  double period_s = 0.0;   ///< between conversions; 0: it converts when it is read (direct)
  double latency_s = 0.0;  ///< from a conversion until it can be read
  double count = 0.0;      ///< size of a count; 0: follows from bits

  std::int64_t full_scale() const {
    if (count > 0.0) return std::max<std::int64_t>(1, std::llround((high - low) / count));
    return (std::int64_t{1} << (bits == 0 ? 30 : bits)) - 1;
  }
  double per_count() const { return (high - low) / static_cast<double>(full_scale()); }
};

/// Faults that can be injected.
struct ConverterFaults {
  bool silent = false;  ///< no new conversions: the last one grows old
  bool frozen = false;  ///< new conversions of the old value, without its noise
  bool loose = false;   ///< the wire is off: reads far out of range
  double offset = 0.0;  ///< added to the truth
  hal::Status status = hal::Status::ok;
  double gain = 1.0;  ///< reading over truth

  friend bool operator==(const ConverterFaults&, const ConverterFaults&) = default;
};

class SimulatedConverter final : public hal::AdcChannel {
 public:
  SimulatedConverter(const ConverterSettings& settings, std::uint64_t seed) : generator_(seed) {
    set(settings);
  }

  hal::Sample latest() override;

  /// Advances the time to `now`, when the true value is `value`.
  void offer(double value, hal::Time now);
  /// The noise sequence continues.
  void set(const ConverterSettings& settings) {
    settings_ = settings;
    full_scale_ = static_cast<double>(settings.full_scale());
    counts_per_unit_ = full_scale_ / (settings.high - settings.low);
    period_ = hal::duration_from(settings.period_s);
    latency_ = hal::duration_from(settings.latency_s);
  }
  void set(const ConverterFaults& faults) { faults_ = faults; }
  const ConverterSettings& settings() const { return settings_; }

 private:
  std::int32_t convert(double value);

  ConverterSettings settings_;
  double full_scale_ = 1.0;
  double counts_per_unit_ = 1.0;
  hal::Duration period_{};
  hal::Duration latency_{};
  ConverterFaults faults_;
  boost::random::mt19937_64 generator_;
  boost::random::normal_distribution<double> normal_;
  double value_ = 0.0;
  hal::Time now_{};
  bool converted_ = false;  ///< the truth at now_ has been converted
  hal::Time next_{};
  hal::Sample last_;
  boost::circular_buffer<hal::Sample> pending_{4096};
};

}  // namespace supercoil::host_sim
