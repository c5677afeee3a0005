#include "apps/supercoil/doctor/readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace supercoil::doctor {

namespace {

using hal::Finding;
using hal::Severity;

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

/// The rail at which all readings are stuck; empty: none.
std::string rail(const Readings& readings, const std::optional<hal_linux::CountRange>& range) {
  if (!range || readings.min() != readings.max()) return {};
  if (readings.min() == range->min) return "lowest";
  if (readings.min() == range->max) return "highest";
  return {};
}

}  // namespace

void Readings::add(const hal::Sample& sample, hal::Duration took) {
  time_ += took;
  if (sample.status != hal::Status::ok) {
    ++failed_;
    failure_ = sample.status;
    return;
  }
  min_ = good_ == 0 ? sample.counts : std::min(min_, sample.counts);
  max_ = good_ == 0 ? sample.counts : std::max(max_, sample.counts);
  ++good_;
  sum_ += sample.counts;
  sum_of_squares_ += static_cast<double>(sample.counts) * sample.counts;
}

double Readings::mean() const {
  return good_ == 0 ? 0.0 : sum_ / static_cast<double>(good_);
}

double Readings::rms() const {
  if (good_ == 0) return 0.0;
  const double variance = sum_of_squares_ / static_cast<double>(good_) - mean() * mean();
  return std::sqrt(std::max(0.0, variance));
}

hal::Duration Readings::mean_time() const {
  const std::int64_t all = good_ + failed_;
  return all == 0 ? hal::Duration{} : time_ / all;
}

Finding assess(const std::string& what, const std::string& where, const Readings& readings,
               const Expected& expected, const std::optional<hal_linux::CountRange>& range) {
  const std::int64_t all = readings.good() + readings.failed();
  if (readings.failed() > 0) {
    return {what, Severity::problem,
            where + ": " + std::to_string(readings.failed()) + " of " + std::to_string(all) +
                " readings failed (" + hal::text(readings.failure()) + ")",
            "check what else uses the device or its bus (dmesg), and its wires"};
  }
  const auto in_unit = [&](double counts) {
    return counts * expected.scaling.per_count + expected.scaling.offset;
  };
  const auto text = [&](double value) { return number(expected.shown_per_unit * value); };
  const double first = in_unit(readings.min());
  const double second = in_unit(readings.max());
  const double low = std::min(first, second);
  const double high = std::max(first, second);
  const std::string unit = " " + expected.unit;
  const std::string band = text(expected.min) + " to " + text(expected.max) + unit;
  const std::string found = where + ": " + text(low) + " to " + text(high) + unit + ", noise " +
                            text(std::abs(expected.scaling.per_count) * readings.rms()) + unit +
                            " rms, " + std::to_string(all) + " readings";
  if (const std::string end = rail(readings, range); !end.empty()) {
    return {what, Severity::problem,
            found + ", all of them " + std::to_string(readings.min()) +
                " counts: stuck at the converter's " + end + " rail",
            "check for a wire that is off or shorted at " + expected.quantity};
  }
  if (low < expected.min || high > expected.max) {
    return {what, Severity::problem, found + ": must be " + band, expected.remedy};
  }
  if (expected.must_move && readings.min() == readings.max()) {
    return {what, Severity::warning,
            found + ": the same " + std::to_string(readings.min()) + " counts each time",
            "move it by hand and run this again: a sensor without noise cannot be distinguished "
            "from a frozen one"};
  }
  return {what, Severity::ok, found, ""};
}

}  // namespace supercoil::doctor
