#include <array>
#include <charconv>
#include <cmath>

#include "recorder/quantities.hpp"
#include "recorder/recording.hpp"

namespace supercoil::recorder {

namespace {

constexpr std::size_t part_bytes = 1 << 18;
/// Never with an exponent, which some spreadsheets take for text.
template <class Number>
void add(std::string& line, Number value) {
  if (!std::isnan(value)) {
    std::array<char, 400> text{};
    char* const end = text.data() + text.size();
    line.append(text.data(), std::to_chars(text.data(), end, value, std::chars_format::fixed).ptr);
  }
  line += ',';
}

std::string columns() {
  std::string line = "time_s,channel";
  for (const Quantity& quantity : quantities) {
    line += ',';
    line += quantity.name;
  }
  return line + '\n';
}

void add_row(std::string& line, const Row& row, double time_s) {
  add(line, time_s);
  line += std::to_string(row.channel + 1) + ',';
  for (const Quantity& quantity : quantities) {
    const double value = quantity.of(row);
    if (quantity.word != nullptr) {
      line += quantity.word(static_cast<std::uint8_t>(value)) + ',';
    } else {
      add(line, static_cast<float>(value));
    }
  }
  line.back() = '\n';
}

}  // namespace

Result<void> to_csv(const Recording& recording, const Sink& sink) {
  std::string part = columns();
  part.reserve(part_bytes + 4096);
  for (const Row& row : recording.rows) {
    add_row(part, row, recording.time_s(row));
    if (part.size() < part_bytes) continue;
    if (auto written = sink(part); !written) return written;
    part.clear();
  }
  return part.empty() ? Result<void>{} : sink(part);
}

}  // namespace supercoil::recorder
