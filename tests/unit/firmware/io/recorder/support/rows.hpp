// Rows for tests, each identifiable by its content.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "recorder/recording.hpp"
#include "storage/crc32.hpp"

namespace supercoil::test {

inline constexpr double rate_Hz = 100.0;
inline constexpr std::int64_t tick_ns = 10'000'000;
inline constexpr std::int64_t second_ns = 1'000'000'000;

inline Row row(std::int64_t time_ns, int channel, Fault fault = Fault::none) {
  Row made{};
  made.time_ns = time_ns;
  made.channel = static_cast<std::uint8_t>(channel);
  made.fault = static_cast<std::uint8_t>(fault);
  made.state = static_cast<std::uint8_t>(fault == Fault::none ? State::active : State::fault);
  const std::int64_t tick = time_ns / tick_ns;
  made.position_m = static_cast<float>(tick) * 1e-6F;
  return made;
}

inline std::string_view bytes_of(const std::vector<Row>& rows) {
  return {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row)};
}

/// A complete file with these rows of two channels and a fault on channel 2 at 5 s.
inline std::string file_of(const std::vector<Row>& rows) {
  recorder::Header header;
  header.rows = rows.size();
  header.channels = 2;
  header.rate_Hz = rate_Hz;
  header.fault = static_cast<std::uint8_t>(Fault::over_temperature);
  header.fault_name = "over_temperature";
  header.fault_channel = 1;
  header.fault_time_ns = 5 * second_ns;
  header.rows_crc32 = storage::crc32(bytes_of(rows));
  return encode(header) + std::string(bytes_of(rows));
}

}  // namespace supercoil::test
