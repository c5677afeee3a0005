// Learned sets for tests: any valid one, and a series of different ones.
#pragma once

#include <cmath>
#include <limits>
#include <ostream>
#include <string>

#include <rapidcheck.h>

#include "storage/codec.hpp"

namespace supercoil::test {

/// The n-th of a series of valid sets; each differs from the others in every quantity. n >= 0.
inline board::Learned nth_set(int n) {
  const double factor = 1.0 + 1e-3 * n;
  board::Learned set;
  set.muscle = {0.162 * factor, 0.089 * factor, 16.0 * factor,
                2.0 * factor,   0.09 * factor,  0.0086 * factor};
  set.calibration = {1e-4 * n, 0.5 + 1e-4 * n, 10.0 * factor};
  return set;
}

/// The answer of decoding a file.
inline std::string answer(const std::string& text) {
  const auto set = storage::decode(text);
  return set ? "in order" : set.error().text();
}

/// The number of a set in the series, whatever its version; −1 if it is not in it, or a mixture.
inline int which(const board::Learned& set) {
  const int n = static_cast<int>(std::lround(set.calibration.position_offset_m * 1e4));
  return n >= 0 && board::same_content(set, nth_set(n)) ? n : -1;
}

/// Doubles from lowest to highest, of every magnitude in the range, with all bits random; lowest >
/// 0 is required.
inline rc::Gen<double> any_magnitude(double lowest, double highest) {
  return rc::gen::map(
      rc::gen::resize(100, rc::gen::arbitrary<std::uint64_t>()), [=](std::uint64_t bits) {
        const double share = static_cast<double>(bits >> 11) * 0x1p-53;
        const double value = std::exp(std::log(lowest) + share * std::log(highest / lowest));
        return std::min(std::max(value, lowest), highest);
      });
}

/// Both signs, zeros, and subnormal numbers.
inline rc::Gen<double> any_offset() {
  const auto sign = rc::gen::element(-1.0, 1.0);
  const auto size = rc::gen::oneOf(any_magnitude(1e-12, 1.0),
                                   any_magnitude(std::numeric_limits<double>::denorm_min(), 1e-300),
                                   rc::gen::element(0.0, 1.0, std::numeric_limits<double>::min()));
  return rc::gen::apply([](double a, double b) { return a * b; }, sign, size);
}

/// None, or one with all bits random.
inline rc::Gen<board::SenseComparison> comparisons() {
  return rc::gen::oneOf(rc::gen::just(board::SenseComparison{}),
                        rc::gen::apply(
                            [](double supply, double current, double error, double time) {
                              return board::SenseComparison{supply, current, error, time};
                            },
                            any_magnitude(0.5, 2.0), any_magnitude(0.5, 2.0),
                            any_magnitude(1e-3, 0.2), any_magnitude(1.0, 2e11)));
}

inline rc::Gen<board::ThermalFacts> heat_facts() {
  return rc::gen::oneOf(
      rc::gen::just(board::ThermalFacts{}),
      rc::gen::apply(
          [](double time_s, double at_W, double rise_K, double error_K, double power_W) {
            return board::ThermalFacts{time_s, at_W, rise_K, error_K, power_W, 1.01 * power_W};
          },
          any_magnitude(1e-3, 1e4), any_magnitude(1e-3, 1e3), any_magnitude(1e-3, 300.0),
          any_magnitude(1e-3, 100.0), any_magnitude(1e-3, 900.0)));
}

/// None, or one with a date.
inline rc::Gen<board::Identification> identifications() {
  return rc::gen::oneOf(
      rc::gen::just(board::Identification{}),
      rc::gen::apply(
          [](double theta1, double theta2, double theta3, double theta4, double time_s) {
            return board::Identification{{theta1, theta2, theta3, theta4}, time_s};
          },
          any_magnitude(1e-9, 10.0), any_magnitude(1e-9, 10.0), any_magnitude(1e-9, 10.0),
          any_magnitude(1e-9, 10.0), any_magnitude(1.0, 2e11)));
}

/// Any set that passes check(), including the ends of the ranges.
inline rc::Gen<board::Learned> learned_sets() {
  return rc::gen::apply(
      [](double psi, double eta, double rho, double mu, double mass, double gamma, double offset,
         double scale, double resistance, const board::SenseComparison& senses,
         const board::ThermalFacts& heat, double response_ratio, double unexplained_ratio,
         const board::Identification& identification, std::uint32_t version) {
        return board::Learned{{psi, eta, rho, mu, mass, gamma},
                              {offset, scale, resistance},
                              senses,
                              version,
                              true,
                              heat,
                              response_ratio,
                              unexplained_ratio,
                              identification,
                              {}};
      },
      any_magnitude(1e-4, 1e3), any_magnitude(1e-5, 1e3), any_magnitude(1e-2, 1e6),
      any_magnitude(1e-4, 1e5), any_magnitude(1e-5, 1e3), any_magnitude(1e-6, 1e3), any_offset(),
      any_magnitude(0.1, 10.0), any_magnitude(1e-2, 1e4), comparisons(), heat_facts(),
      rc::gen::oneOf(rc::gen::just(0.0), any_magnitude(1e-3, 10.0)),
      rc::gen::oneOf(rc::gen::just(0.0), any_magnitude(1e-6, 1.0)), identifications(),
      rc::gen::resize(100, rc::gen::arbitrary<std::uint32_t>()));
}

}  // namespace supercoil::test

namespace supercoil::storage {
inline void showValue(const board::Learned& set, std::ostream& out) {
  out << encode(set);
}
}  // namespace supercoil::storage
