// A converter's readings while everything is off.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "supercoil/hal/adc_channel.hpp"
#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/iio_device.hpp"

#include "board/measurement.hpp"

namespace supercoil::doctor {

/// Successive conversions of one converter.
class Readings {
 public:
  /// took: how long the read took.
  void add(const hal::Sample& sample, hal::Duration took);

  std::int64_t good() const { return good_; }
  std::int64_t failed() const { return failed_; }
  hal::Status failure() const { return failure_; }
  std::int32_t min() const { return min_; }
  std::int32_t max() const { return max_; }
  double mean() const;  ///< counts
  double rms() const;   ///< counts, around the mean
  hal::Duration mean_time() const;

 private:
  std::int64_t good_ = 0;
  std::int64_t failed_ = 0;
  hal::Status failure_ = hal::Status::ok;  ///< the last one
  std::int32_t min_ = 0;
  std::int32_t max_ = 0;
  double sum_ = 0.0;
  double sum_of_squares_ = 0.0;
  hal::Duration time_{};
};

/// Expected readings of a converter while its board is off.
struct Expected {
  std::string quantity;  ///< "the supply"
  board::Scaling scaling;
  double min = 0.0;  ///< in its unit
  double max = 0.0;
  std::string unit;             ///< as shown
  double shown_per_unit = 1.0;  ///< 1e3 shows metres as mm
  bool must_move = false;       ///< a value that never changes is invalid
  std::string remedy;           ///< for a value out of range
};

/// range: of the converter's counts, if it is known.
hal::Finding assess(const std::string& what, const std::string& where, const Readings& readings,
                    const Expected& expected, const std::optional<hal_linux::CountRange>& range);

}  // namespace supercoil::doctor
