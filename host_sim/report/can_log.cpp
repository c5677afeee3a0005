#include "report/can_log.hpp"

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

namespace supercoil::host_sim {

namespace {

constexpr std::string_view hexadecimal = "0123456789ABCDEF";

/// With leading zeros.
template <unsigned Base>
void add_number(std::string& text, std::uint64_t number, std::size_t digits) {
  const std::size_t at = text.size();
  text.append(digits, '0');
  for (std::size_t i = digits; i-- > 0; number /= Base)
    text[at + i] = hexadecimal[number % Base];
}

}  // namespace

std::string candump_line(const hal::CanFrame& frame, hal::Time since_start,
                         const std::string& interface) {
  const auto microseconds =
      static_cast<std::uint64_t>(std::max<std::int64_t>(0, since_start.count() / 1000));
  std::string line = "(";
  add_number<10>(line, microseconds / 1'000'000, 10);
  line += '.';
  add_number<10>(line, microseconds % 1'000'000, 6);
  line += ") " + interface + ' ';
  add_number<16>(line, frame.id, 3);
  line += '#';
  for (std::size_t i = 0; i < frame.length; ++i)
    add_number<16>(line, frame.data[i], 2);
  return line + '\n';
}

CanLog::CanLog(const std::filesystem::path& path, std::string interface)
    : out_(path, std::ios::binary), interface_(std::move(interface)) {}

void CanLog::add(const hal::CanFrame& frame, hal::Time since_start) {
  out_ << candump_line(frame, since_start, interface_);
}

tl::expected<void, std::string> CanLog::finish() {
  out_.close();
  if (out_) return {};
  return tl::unexpected("can.log: cannot be written: " + std::generic_category().message(errno));
}

}  // namespace supercoil::host_sim
