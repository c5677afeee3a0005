#include "recorder/header.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "storage/crc32.hpp"
#include "text/number_text.hpp"

namespace supercoil::recorder {

namespace {

constexpr std::uint64_t max_rows = std::uint64_t{1} << 32;

std::string hexadecimal(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%08x", static_cast<unsigned>(value));
  return text.data();
}

/// It holds the CRC of everything after it in the header.
std::string first_line(std::string_view rest) {
  return std::string(magic) + std::to_string(recording_format) + ", CRC-32 " +
         hexadecimal(storage::crc32(rest)) + "\n";
}

/// The text after "key = ", up to the end of the line.
std::string_view value_of(std::string_view text, std::string_view key) {
  const std::string start = "\n" + std::string(key) + " = ";
  const std::size_t at = text.find(start);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + start.size());
  return text.substr(0, text.find('\n'));
}

/// Reads values, and remembers the first that is invalid.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  template <class Number>
  Number number(std::string_view key, Number min, Number max) {
    const std::string_view value = value_of(text_, key);
    Number result{};
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), result);
    const bool read = error == std::errc() && end == value.data() + value.size();
    if (!read || !(result >= min && result <= max)) note(key, value);
    return result;
  }
  /// Without its quotes.
  std::string_view quoted(std::string_view key) {
    const std::string_view value = value_of(text_, key);
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
      return value.substr(1, value.size() - 2);
    note(key, value);
    return {};
  }
  std::uint32_t crc(std::string_view key) {
    const std::string_view value = quoted(key);
    std::uint32_t result = 0;
    const auto [end, error] =
        std::from_chars(value.data(), value.data() + value.size(), result, 16);
    if (error != std::errc() || end != value.data() + value.size()) note(key, value);
    return result;
  }
  const std::string& wrong() const { return wrong_; }

 private:
  void note(std::string_view key, std::string_view value) {
    if (wrong_.empty()) wrong_ = std::string(key) + " = " + std::string(value);
  }

  std::string_view text_;
  std::string wrong_;
};

}  // namespace

std::string encode(const Header& h) {
  std::string rest =
      "# Rows follow at byte 512. To read them: supercoil log FILE\n"
      "row_bytes = " +
      std::to_string(sizeof(Row)) + "\nrows = " + shortest_text(h.rows) +
      "\nchannels = " + shortest_text(h.channels) + "\nrate_Hz = " + shortest_text(h.rate_Hz) +
      "\nfault = " + std::to_string(h.fault) + "\nfault_name = \"" + h.fault_name +
      "\"\nfault_channel = " + shortest_text(h.fault_channel + 1) +
      "\nfault_time_ns = " + shortest_text(h.fault_time_ns) + "\nrows_CRC32 = \"" +
      hexadecimal(h.rows_crc32) + "\"\n";
  if (!h.program.empty()) rest += "program = \"" + h.program + "\"\n";
  rest.resize(header_bytes - first_line("").size() - 1, ' ');
  rest += '\n';
  return first_line(rest) + rest;
}

std::string format_problem(std::string_view file) {
  if (file.empty()) return "is empty";
  if (!file.starts_with(magic)) {
    if (magic.starts_with(file)) return "is cut off in its first line";
    return "is not a flight recording: it does not start with '" + std::string(magic) + "'";
  }
  unsigned format = 0;
  const std::string_view behind = file.substr(magic.size());
  const auto read = std::from_chars(behind.data(), behind.data() + behind.size(), format);
  if (read.ec == std::errc() && format != recording_format) {
    return "is of format " + std::to_string(format) + "; this program reads format " +
           std::to_string(recording_format);
  }
  if (file.size() < header_bytes) {
    return "is cut off in its header: " + std::to_string(file.size()) + " of " +
           std::to_string(header_bytes) + " bytes are there";
  }
  return {};
}

Result<Header> decode_header(std::string_view start) {
  const std::size_t line = first_line("").size();
  if (start.substr(0, line) != first_line(start.substr(line)))
    return failure("is damaged: its header is not as it was written");
  Reader reader(start);
  const auto row_bytes = reader.number<std::uint64_t>("row_bytes", 1, 1 << 20);
  Header h;
  h.rows = reader.number<std::uint64_t>("rows", 1, max_rows);
  h.channels = reader.number<int>("channels", 1, 16);
  h.rate_Hz = reader.number<double>("rate_Hz", 1e-3, 1e6);
  h.fault = reader.number<std::uint8_t>("fault", 1, 255);
  h.fault_name = std::string(reader.quoted("fault_name"));
  h.fault_channel = reader.number<int>("fault_channel", 1, 16) - 1;
  h.fault_time_ns = reader.number<std::int64_t>("fault_time_ns", INT64_MIN, INT64_MAX);
  h.rows_crc32 = reader.crc("rows_CRC32");
  if (!value_of(start, "program").empty()) h.program = std::string(reader.quoted("program"));
  if (!reader.wrong().empty()) return failure("has an impossible header: " + reader.wrong());
  if (row_bytes != sizeof(Row)) {
    return failure("has rows of " + std::to_string(row_bytes) +
                       " bytes; this program reads rows of " + std::to_string(sizeof(Row)),
                   std::errc::not_supported);
  }
  return h;
}

}  // namespace supercoil::recorder
