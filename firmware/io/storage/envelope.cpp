#include "storage/envelope.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>

#include "storage/crc32.hpp"

namespace supercoil::storage {

namespace {

constexpr std::string_view magic = "# supercoil learned, format ";

std::string hexadecimal(std::uint32_t value, int digits) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%0*x", digits, static_cast<unsigned>(value));
  return text.data();
}

std::string first_line_of(std::string_view body, unsigned format) {
  return std::string(magic) + std::to_string(format) + ", " + std::to_string(body.size()) +
         " bytes, CRC-32 " + hexadecimal(crc32(body), 8);
}

/// Takes a decimal number off the front of text.
bool take_number(std::string_view& text, std::size_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

/// Why the first line does not match the body.
std::string difference(std::string_view line, std::string_view body) {
  constexpr std::string_view between = ", ";
  std::string damaged_line = "is damaged: its first line is not as it was written";
  line.remove_prefix(magic.size());
  std::size_t format = 0;
  if (!take_number(line, format)) return damaged_line;
  if (format > file_format) {
    return "is of format " + std::to_string(format) +
           ", written by a newer firmware; this one reads formats 1 to " +
           std::to_string(file_format);
  }
  std::size_t bytes = 0;
  if (!line.starts_with(between)) return damaged_line;
  line.remove_prefix(between.size());
  if (!take_number(line, bytes)) return damaged_line;
  if (body.size() < bytes) {
    return "is cut off: " + std::to_string(body.size()) + " of " + std::to_string(bytes) +
           " bytes after its first line";
  }
  if (body.size() > bytes) {
    return "has " + std::to_string(body.size() - bytes) + " bytes more than were written";
  }
  return "is damaged: its content and its first line do not match (CRC-32 of the "
         "content: " +
         hexadecimal(crc32(body), 8) + ")";
}

/// Offset of the first byte that is neither printable ASCII nor a newline.
std::size_t first_binary(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size() && (text[at] == '\n' || (text[at] >= ' ' && text[at] <= '~')))
    ++at;
  return at;
}

}  // namespace

std::string seal(std::string_view body, unsigned format) {
  return first_line_of(body, format) + "\n" + std::string(body);
}

Result<Unsealed> unseal(std::string_view text) {
  if (text.empty()) return failure("is empty");
  if (text.size() > max_file_bytes) {
    return failure("is larger than the limit of 64 KiB");
  }
  // A file whose data never reached the disk is often zeros of the right length.
  if (const std::size_t at = first_binary(text); at < text.size()) {
    return failure("is not text: byte 0x" + hexadecimal(static_cast<unsigned char>(text[at]), 2) +
                   " at offset " + std::to_string(at));
  }
  if (!text.starts_with(magic)) {
    if (magic.starts_with(text)) return failure("is cut off in its first line");
    return failure("is not a stored set: it does not start with '" + std::string(magic) + "'");
  }
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) {
    return failure("is cut off in its first line");
  }
  const std::string_view line = text.substr(0, end);
  const std::string_view body = text.substr(end + 1);
  // Compares to the letter: otherwise a change of, say, the CRC's case would go unnoticed.
  for (unsigned format = 1; format <= file_format; ++format) {
    if (line == first_line_of(body, format)) return Unsealed{body, format};
  }
  return failure(difference(line, body));
}

}  // namespace supercoil::storage
