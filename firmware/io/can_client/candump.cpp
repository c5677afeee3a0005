#include "can_client/candump.hpp"

#include "can_client/text.hpp"

namespace supercoil::can_client {

namespace {

constexpr std::size_t digits_of_extended_id = 8;

/// "(SECONDS.MICROSECONDS)"
std::optional<hal::Time> time_of(std::string_view word) {
  if (!word.starts_with('(') || !word.ends_with(')')) return std::nullopt;
  return parse_time(word.substr(1, word.size() - 2));
}

}  // namespace

hal::Time time_of_run(hal::Time in_log) {
  // The longest scenario takes 1e6 s; no supercoil board kept a log in 2001.
  constexpr hal::Time longest_run = std::chrono::hours(24 * 365);
  const hal::Time in_run = in_log - simulation_epoch;
  return in_run >= hal::Time{0} && in_run <= longest_run ? in_run : in_log;
}

std::string candump_line(const hal::CanFrame& frame, hal::Time at, std::string_view interface) {
  std::string line = "(";
  add_time(line, at);
  line += ") ";
  line += interface;
  line += ' ';
  add_number<16>(line, frame.id, digits_of_standard_id);
  line += '#';
  add_bytes(line, frame);
  return line + '\n';
}

Result<LogLine> parse_candump_line(std::string_view line) {
  std::string_view rest = line;
  const auto time = time_of(next_word(rest));
  if (!time) return failure("must begin with (SECONDS.MICROSECONDS)");
  next_word(rest);  // the interface
  const std::string_view frame = next_word(rest);
  const std::size_t mark = frame.find('#');
  if (mark == std::string_view::npos) return failure("must continue with an interface and ID#DATA");
  const auto id = number<std::uint32_t>(frame.substr(0, mark), 16);
  if (!id || (mark != digits_of_standard_id && mark != digits_of_extended_id))
    return failure("an identifier has 3 or 8 hexadecimal digits");
  LogLine read;
  read.frame.received = *time;
  const std::string_view data = frame.substr(mark + 1);
  read.is_standard = mark == digits_of_standard_id && *id < standard_ids &&
                     !data.starts_with('R') && !data.starts_with('#');
  if (!read.is_standard) return read;
  read.frame.id = static_cast<std::uint16_t>(*id);
  if (!parse_bytes(data, read.frame))
    return failure("data must be 0 to 8 bytes of two hexadecimal digits");
  return read;
}

}  // namespace supercoil::can_client
