// A flight recording: its file format, and its conversion to CSV (docs/recorder.md).
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "loop/row.hpp"

namespace supercoil::recorder {

/// Increases when a program for the previous format could no longer read the file.
inline constexpr unsigned recording_format = 1;
/// The rows start here whatever the header says, so that they are found when it is damaged.
inline constexpr std::size_t header_bytes = 512;

static_assert(std::endian::native == std::endian::little, "rows are written as they are in memory");

/// What the file says about its rows.
struct Header {
  std::uint64_t rows = 0;
  int channels = 1;        ///< 1 to 16
  double rate_Hz = 0.0;    ///< 0: not known, the header is damaged
  std::uint8_t fault = 0;  ///< its number; this program may not know it
  std::string fault_name;  ///< as named by the firmware that wrote the file
  int fault_channel = 0;   ///< from 0
  std::int64_t fault_time_ns = 0;
  std::uint32_t rows_crc32 = 0;
  std::string program;  ///< version that wrote the file; empty: one from before this field

  bool operator==(const Header&) const = default;
};

/// A file's rows, in the order in which they were recorded.
struct Recording {
  Header header;
  std::vector<Row> rows;
  /// What is wrong with a file that was read nevertheless; empty for an intact one.
  std::string damage;

  /// Relative to the fault; negative before it.
  double time_s(const Row& row) const {
    // Unsigned: times of a damaged file may be further apart than a signed number holds.
    const auto apart =
        static_cast<std::uint64_t>(row.time_ns) - static_cast<std::uint64_t>(header.fault_time_ns);
    return static_cast<double>(static_cast<std::int64_t>(apart)) / 1e9;
  }
};

/// The first header_bytes of a file. fault_name must be letters, digits and '_', at most 40;
/// program letters, digits, '.' and '+', at most 40.
std::string encode(const Header& header);

/// What decode() does with a damaged file.
enum class Damaged { refuse, read };

/// The error says what is wrong: empty, not a recording, another format, another row size, cut off,
/// extra bytes at its end, or changed. Damaged::read returns all whole rows, and `damage` says what
/// is wrong; it still fails if no row can be identified.
Result<Recording> decode(std::string_view file, Damaged damaged);

/// Only the rows with from_s <= time_s <= to_s and of this channel (from 0; -1: all).
void select(Recording& recording, double from_s, double to_s, int channel);

/// Takes the next part of a text; the error says why it could not be written.
using Sink = std::function<Result<void>(std::string_view)>;

/// Writes the rows as CSV after a line of column names. Numbers have the digits that it takes to
/// read the same float back; NaN is an empty field. Stops at the sink's first error.
Result<void> to_csv(const Recording& recording, const Sink& sink);

}  // namespace supercoil::recorder
