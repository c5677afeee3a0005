// The only place where raw counts become units.
#pragma once

#include <cmath>

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

/// max_age_s > 0. A conversion further in the future than that (a clock went wrong) is absent as
/// well.
/// The result is written in place: it is read again within nanoseconds.
inline void measure(const hal::Sample& sample, const Scaling& scaling, hal::Time now,
                    double max_age_s, Measured& result) {
  result.status = sample.status;
  // A conversion just after the tick's time was read is fresh. One much later means that a clock
  // went wrong.
  const double age_s = hal::seconds(now - sample.taken);
  result.age_s = age_s > 0.0 ? age_s : 0.0;
  result.present = sample.status == hal::Status::ok && std::abs(age_s) <= max_age_s;
  result.value = result.present ? sample.counts * scaling.per_count + scaling.offset : 0.0;
}

}  // namespace supercoil::board
