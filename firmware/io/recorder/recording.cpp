#include "recorder/recording.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

#include "recorder/header.hpp"
#include "storage/crc32.hpp"

namespace supercoil::recorder {

namespace {

/// The row in which the first fault latches. If none does, the first row with a fault, which was
/// there before the recording began; null: no row has one.
const Row* row_of_fault(const std::vector<Row>& rows) {
  std::array<const Row*, 256> last{};
  const Row* older = nullptr;
  for (const Row& row : rows) {
    const Row* before = std::exchange(last[row.channel], &row);
    if (row.fault == 0) continue;
    if (before != nullptr && before->fault == 0) return &row;
    if (older == nullptr) older = &row;
  }
  return older;
}

/// Rebuilds the header from the rows when the stored one is damaged.
Header header_from(const std::vector<Row>& rows) {
  Header header;
  header.rows = rows.size();
  for (const Row& row : rows)
    header.channels = std::max(header.channels, std::min(row.channel + 1, 16));
  if (const Row* fault = row_of_fault(rows)) {
    header.fault = fault->fault;
    header.fault_channel = fault->channel;
    header.fault_time_ns = fault->time_ns;
  } else if (!rows.empty()) {
    header.fault_time_ns = rows.back().time_ns;
  }
  return header;
}

/// What is wrong with the rows; empty when they match the header.
std::string fault_of_rows(const Header& header, std::string_view bytes) {
  const std::uint64_t whole = bytes.size() / sizeof(Row);
  if (whole < header.rows) {
    return "is cut off: " + std::to_string(whole) + " of " + std::to_string(header.rows) +
           " rows are there";
  }
  if (bytes.size() > header.rows * sizeof(Row)) {
    return "has " + std::to_string(bytes.size() - header.rows * sizeof(Row)) +
           " bytes more than were written";
  }
  const std::uint32_t crc = storage::crc32(bytes);
  if (crc == header.rows_crc32) return {};
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(),
                "is damaged: its rows have the CRC-32 %08x, not %08x as when they were written",
                static_cast<unsigned>(crc), static_cast<unsigned>(header.rows_crc32));
  return text.data();
}

}  // namespace

Result<Recording> decode(std::string_view file, Damaged damaged) {
  if (auto foreign = format_problem(file); !foreign.empty()) return failure(std::move(foreign));
  const std::string_view bytes = file.substr(header_bytes);
  Recording recording;
  auto header = decode_header(file.substr(0, header_bytes));
  if (header) {
    recording.header = std::move(*header);
    recording.damage = fault_of_rows(recording.header, bytes);
  } else {
    if (header.error().code == std::errc::not_supported) return tl::unexpected(header.error());
    recording.damage = header.error().text();
  }
  if (damaged == Damaged::refuse && !recording.damage.empty())
    return failure(std::move(recording.damage));
  std::uint64_t rows = bytes.size() / sizeof(Row);
  if (header) rows = std::min(rows, recording.header.rows);
  if (rows == 0) return failure("has no whole row: it " + recording.damage);
  recording.rows.resize(rows);
  std::memcpy(recording.rows.data(), bytes.data(), rows * sizeof(Row));
  if (!header) recording.header = header_from(recording.rows);
  return recording;
}

void select(Recording& recording, double from_s, double to_s, int channel) {
  std::erase_if(recording.rows, [&](const Row& row) {
    const double time_s = recording.time_s(row);
    return time_s < from_s || time_s > to_s || (channel >= 0 && row.channel != channel);
  });
}

}  // namespace supercoil::recorder
