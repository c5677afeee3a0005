#include "apps/supercoil/setup/operator.hpp"

#include <charconv>
#include <cmath>

#include "text/number_text.hpp"

namespace supercoil::operating {

std::string range_text(const config::Range& range) {
  return number_text(range.min, range_digits) + " to " + number_text(range.max, range_digits);
}

double rounded_down(double value, int significant_digits) {
  if (!(value > 0.0)) return 0.0;
  const double step = std::pow(10.0, std::floor(std::log10(value)) - (significant_digits - 1));
  return step * std::floor(value / step + 1e-6);
}

Operator::Answer read_answer(const Question& question, const std::string& text) {
  double value = question.fallback;
  if (!text.empty()) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end) value = NAN;
  }
  if (question.allows(value)) return value;
  return failure("'" + text + "' is refused: it must be a number from " +
                 range_text(question.allowed));
}

}  // namespace supercoil::operating
