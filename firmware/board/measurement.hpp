// The only place where raw counts become units.
#pragma once

#include "supercoil/hal/adc_channel.hpp"

namespace supercoil::board {

/// A value with its age. A value that is too old, or could not be read, is absent, never the old
/// number.
struct Measured {
  double value = 0.0;
  double age_s = 0.0;
  bool present = false;
  hal::Status status = hal::Status::not_ready;
};

/// unit = counts · per_count + offset.
struct Scaling {
  double per_count = 1.0;
  double offset = 0.0;
};

/// max_age_s > 0. A conversion from the future (a clock that went wrong) is absent as well.
inline Measured measure(const hal::Sample& sample, const Scaling& scaling, hal::Time now,
                        double max_age_s) {
  Measured result;
  result.status = sample.status;
  if (sample.status != hal::Status::ok) return result;
  result.age_s = hal::seconds(now - sample.taken);
  result.present = result.age_s >= 0.0 && result.age_s <= max_age_s;
  if (result.present) result.value = sample.counts * scaling.per_count + scaling.offset;
  return result;
}

}  // namespace supercoil::board
