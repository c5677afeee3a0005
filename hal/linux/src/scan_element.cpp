#include "supercoil/hal_linux/scan_element.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>

namespace supercoil::hal_linux {

namespace {

/// Takes the parts of a text from its front; after a missing one, nothing more is taken.
class Parts {
 public:
  explicit Parts(std::string_view text) : rest_(text) {}

  bool take(std::string_view part) {
    if (!good_ || !rest_.starts_with(part)) return false;
    rest_.remove_prefix(part.size());
    return true;
  }
  void expect(std::string_view part) { good_ = take(part); }
  int number() {
    int value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    // from_chars accepts a minus; none of these numbers may have one.
    good_ = good_ && error == std::errc{} && value >= 0 && rest_.front() != '-';
    if (good_) rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  bool whole() const { return good_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool good_ = true;
};

bool possible(const ScanType& type) {
  const auto sizes = {8, 16, 32, 64};
  return std::find(sizes.begin(), sizes.end(), type.storage_bits) != sizes.end() &&
         type.bits >= 1 && type.bits <= type.storage_bits &&
         type.shift <= type.storage_bits - type.bits;
}

std::size_t aligned(std::size_t offset, std::size_t to) {
  return (offset + to - 1) / to * to;
}

}  // namespace

Result<ScanType> parse_scan_type(std::string_view text) {
  Parts parts(text);
  ScanType type;
  type.big_endian = parts.take("be:");
  if (!type.big_endian) parts.expect("le:");
  type.is_signed = parts.take("s");
  if (!type.is_signed) parts.expect("u");
  type.bits = parts.number();
  parts.expect("/");
  type.storage_bits = parts.number();
  const bool single = !parts.take("X") || parts.number() == 1;
  parts.expect(">>");
  type.shift = parts.number();
  if (single && parts.whole() && possible(type)) return type;
  return failure("'" + std::string(text) + "' is not a scan type such as le:s12/16>>4");
}

std::int64_t value_of(const ScanType& type, const std::byte* bytes) noexcept {
  constexpr int bits_of_a_byte = 8;
  constexpr int max_bits = 64;
  std::uint64_t stored = 0;
  const std::size_t count = type.bytes();
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte next = bytes[type.big_endian ? i : count - 1 - i];
    stored = stored << bits_of_a_byte | std::to_integer<std::uint64_t>(next);
  }
  // The bits to the top, and down again: the second shift extends the sign.
  const int spare = max_bits - type.bits;
  const std::uint64_t at_top = stored >> type.shift << spare;
  return type.is_signed ? static_cast<std::int64_t>(at_top) >> spare
                        : static_cast<std::int64_t>(at_top >> spare);
}

std::size_t lay_out(std::vector<ScanElement>& elements) {
  std::sort(elements.begin(), elements.end(),
            [](const ScanElement& a, const ScanElement& b) { return a.index < b.index; });
  std::size_t end = 0;
  std::size_t alignment = 1;
  for (ScanElement& element : elements) {
    element.offset = aligned(end, element.type.bytes());
    end = element.offset + element.type.bytes();
    alignment = std::max(alignment, element.type.bytes());
  }
  return aligned(end, alignment);
}

}  // namespace supercoil::hal_linux
