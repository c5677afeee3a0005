// Saturating fixed-point numbers for controllers and estimators.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace supercoil::control {

namespace detail {
__extension__ using Int128 = __int128;
}

/// A signed fixed-point number of IntegerBits (sign included) and FractionBits, 32 or 64 in all.
///
/// Nothing wraps: every result that does not fit becomes max() or min(). Products and quotients are
/// formed in twice the width and rounded to nearest; products round ties upward, quotients away
/// from zero. All of it is integer arithmetic, so results are bit-identical everywhere.
///
/// NaN has no fixed-point value and converts to 0. Callers that may see a NaN test for it first.
template <int IntegerBits, int FractionBits>
class Fixed {
  static_assert(IntegerBits >= 2 && FractionBits >= 1);
  static_assert(IntegerBits + FractionBits == 32 || IntegerBits + FractionBits == 64);

 public:
  static constexpr int integer_bits = IntegerBits;
  static constexpr int fraction_bits = FractionBits;
  using Raw = std::conditional_t<IntegerBits + FractionBits == 32, std::int32_t, std::int64_t>;
  using Wide = std::conditional_t<IntegerBits + FractionBits == 32, std::int64_t, detail::Int128>;

  constexpr Fixed() = default;
  constexpr explicit Fixed(double value) : raw_(raw_from(value)) {}
  constexpr explicit Fixed(float value) : Fixed(static_cast<double>(value)) {}
  constexpr explicit Fixed(int value)
      : raw_(clamp(static_cast<Wide>(value) * (Wide{1} << FractionBits))) {}

  /// From another format: rounded to nearest (ties upward), saturated.
  template <int I, int F>
  constexpr explicit Fixed(Fixed<I, F> other) {
    if constexpr (F > FractionBits) {
      constexpr int shift = F - FractionBits;
      // Rounds up when the part cut off is half or more: its first bit is set.
      raw_ = clamp((other.raw() >> shift) + ((other.raw() >> (shift - 1)) & 1));
    } else if constexpr (I <= IntegerBits) {
      raw_ = static_cast<Raw>(other.raw()) << (FractionBits - F);
    } else {
      raw_ = clamp(static_cast<detail::Int128>(other.raw())
                   << (FractionBits - F));  // C++20: defined for negative values
    }
  }

  /// raw: the value in steps of resolution().
  static constexpr Fixed from_raw(Raw raw) {
    Fixed result;
    result.raw_ = raw;
    return result;
  }
  constexpr Raw raw() const { return raw_; }

  static constexpr Fixed max() { return from_raw(std::numeric_limits<Raw>::max()); }
  static constexpr Fixed min() { return from_raw(std::numeric_limits<Raw>::min()); }
  static constexpr Fixed resolution() { return from_raw(1); }
  /// True when an operation has (or may have) saturated.
  constexpr bool at_limit() const { return *this == max() || *this == min(); }

  constexpr explicit operator double() const { return static_cast<double>(raw_) / scale; }
  constexpr explicit operator float() const { return static_cast<float>(double{*this}); }
  constexpr explicit operator int() const {
    return static_cast<int>(raw_ / (Raw{1} << FractionBits));
  }

  constexpr Fixed operator-() const { return raw_ == min().raw_ ? max() : from_raw(-raw_); }
  constexpr Fixed& operator+=(Fixed other) {
    Raw sum = 0;
    const bool overflow = __builtin_add_overflow(raw_, other.raw_, &sum);
    if (overflow) [[unlikely]]
      sum = limit(other.raw_ < 0);
    raw_ = sum;
    return *this;
  }
  constexpr Fixed& operator-=(Fixed other) {
    Raw difference = 0;
    const bool overflow = __builtin_sub_overflow(raw_, other.raw_, &difference);
    if (overflow) [[unlikely]]
      difference = limit(other.raw_ > 0);
    raw_ = difference;
    return *this;
  }
  constexpr Fixed& operator*=(Fixed other) {
    const Wide product = static_cast<Wide>(raw_) * other.raw_;
    raw_ = clamp((product + (Wide{1} << (FractionBits - 1))) >> FractionBits);
    return *this;
  }
  /// Division by zero saturates with the sign of the dividend; 0/0 is 0.
  constexpr Fixed& operator/=(Fixed other) {
    if (other.raw_ == 0) {
      raw_ = raw_ == 0 ? Raw{0} : limit(raw_ < 0);
      return *this;
    }
    const Wide dividend = static_cast<Wide>(raw_) * (Wide{1} << FractionBits);
    const Wide half = (other.raw_ < 0 ? -Wide{other.raw_} : Wide{other.raw_}) / 2;
    raw_ = clamp((dividend + (dividend < 0 ? -half : half)) / other.raw_);
    return *this;
  }

  friend constexpr Fixed operator+(Fixed a, Fixed b) { return a += b; }
  friend constexpr Fixed operator-(Fixed a, Fixed b) { return a -= b; }
  friend constexpr Fixed operator*(Fixed a, Fixed b) { return a *= b; }
  friend constexpr Fixed operator/(Fixed a, Fixed b) { return a /= b; }
  friend constexpr auto operator<=>(Fixed, Fixed) = default;  // NOLINT(modernize-use-nullptr)

  friend constexpr Fixed abs(Fixed value) { return value.raw_ < 0 ? -value : value; }
  friend constexpr bool isfinite(Fixed) { return true; }
  /// Rounded to nearest; the root of a negative number is 0.
  friend constexpr Fixed sqrt(Fixed value) {
    if (value.raw_ <= 0) return Fixed{};
    const Wide radicand = static_cast<Wide>(value.raw_) << FractionBits;
    Wide root = 0;
    for (Wide bit = Wide{1} << (IntegerBits / 2 + FractionBits); bit != 0; bit >>= 1) {
      const Wide trial = root + bit;
      if (trial <= radicand / trial) root = trial;
    }
    if (radicand - root * root > root) ++root;
    return from_raw(clamp(root));
  }

 private:
  static constexpr double scale = static_cast<double>(Wide{1} << FractionBits);

  static constexpr Raw limit(bool negative) {
    return negative ? std::numeric_limits<Raw>::min() : std::numeric_limits<Raw>::max();
  }
  // One comparison after narrowing, and a well-predicted branch: this is most of the cost of a step
  // in fixed point.
  template <class Integer>
  static constexpr Raw clamp(Integer value) {
    const auto narrow = static_cast<Raw>(value);
    if (value != narrow) [[unlikely]]
      return limit(value < 0);
    return narrow;
  }
  static constexpr Raw raw_from(double value) {
    if (value != value) return 0;
    const double scaled = value * scale;
    constexpr auto bound = static_cast<double>(std::numeric_limits<Raw>::max());
    if (scaled >= bound) return limit(false);
    if (scaled <= -bound - 1.0) return limit(true);
    // Nearest, ties away from zero; std::round is not constexpr in C++20.
    const Raw whole = static_cast<Raw>(scaled);
    const double rest = scaled - static_cast<double>(whole);
    if (rest >= 0.5) return whole + 1;
    if (rest <= -0.5) return whole - 1;
    return whole;
  }

  Raw raw_ = 0;
};

/// The format of signals and gains: ±128 in steps of 6e-8.
using Q8_24 = Fixed<8, 24>;
/// The format of accumulators: ±32768 in steps of 3.6e-15.
using Q16_48 = Fixed<16, 48>;

}  // namespace supercoil::control
