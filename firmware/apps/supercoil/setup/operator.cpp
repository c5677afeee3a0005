#include "apps/supercoil/setup/operator.hpp"

#include <charconv>

#include "text/number_text.hpp"

namespace supercoil::operating {

std::string range_text(const config::Range& range) {
  return number_text(range.lowest, 5) + " to " + number_text(range.highest, 5);
}

Operator::OrWhy read_answer(const Question& question, const std::string& text) {
  double value = question.fallback;
  if (!text.empty()) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end) value = NAN;
  }
  if (question.allows(value)) return value;
  return tl::unexpected("'" + text + "' is refused: it must be a number from " +
                        range_text(question.allowed));
}

}  // namespace supercoil::operating
