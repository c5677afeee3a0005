// The file's format, and every way in which a file can differ from it.
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "storage/crc32.hpp"
#include "unit/firmware/io/recorder/support/rows.hpp"

using namespace supercoil;
using namespace supercoil::test;
using recorder::Damaged;
using recorder::decode;
using recorder::header_bytes;

TEST_GROUP(Recording) {
  std::vector<Row> rows{row(4 * second_ns, 0), row(4 * second_ns, 1), row(5 * second_ns, 0),
                        row(5 * second_ns, 1, Fault::over_temperature)};
  std::string file = file_of(rows);

  std::string error(const std::string& text, Damaged damaged = Damaged::refuse) {
    const auto read = decode(text, damaged);
    return read ? "" : read.error().text();
  }
  /// The header rewritten with one value changed and with a matching CRC.
  std::string with(const std::string& from, const std::string& to) const {
    std::string text = file;
    const std::size_t at = text.find(from);
    CHECK_TEXT(at < header_bytes, from.c_str());
    text.replace(at, from.size(), to);
    const std::size_t padding = text.find("  \n");
    if (to.size() > from.size()) text.erase(padding, to.size() - from.size());
    if (to.size() < from.size()) text.insert(padding, from.size() - to.size(), ' ');
    const std::size_t line = text.find('\n') + 1;
    char crc[9];
    std::snprintf(crc, sizeof crc, "%08x",
                  static_cast<unsigned>(
                      storage::crc32(std::string_view(text).substr(line, header_bytes - line))));
    return text.replace(line - 9, 8, crc);
  }
};

TEST(Recording, RoundTrips) {
  LONGS_EQUAL(header_bytes + 4 * sizeof(Row), file.size());
  const auto read = decode(file, Damaged::refuse);
  CHECK(read.has_value());
  LONGS_EQUAL(4, read->header.rows);
  LONGS_EQUAL(2, read->header.channels);
  CHECK(read->header.rate_Hz == 100.0);
  LONGS_EQUAL(30, read->header.fault);
  STRCMP_EQUAL("over_temperature", read->header.fault_name.c_str());
  LONGS_EQUAL(1, read->header.fault_channel);
  CHECK(read->header.fault_time_ns == 5 * second_ns);
  CHECK(bytes_of(read->rows) == bytes_of(rows));
  STRCMP_EQUAL("", read->header.program.c_str());
  STRCMP_EQUAL("", read->damage.c_str());
}

TEST(Recording, NamesTheProgramThatWroteItIfKnown) {
  recorder::Header header = decode(file, Damaged::refuse)->header;
  header.program = "0.2.0+git20261122.150233.2780ebf";
  file.replace(0, header_bytes, encode(header));
  const auto read = decode(file, Damaged::refuse);
  CHECK(read.has_value());
  STRCMP_EQUAL("0.2.0+git20261122.150233.2780ebf", read->header.program.c_str());
  STRCMP_CONTAINS("program = 0.2", error(with("\"0.2.0", "0.2.0")).c_str());
}

TEST(Recording, FieldOffsetsMatchTheDocumentation) {
  LONGS_EQUAL(0, offsetof(Row, time_ns));
  LONGS_EQUAL(8, offsetof(Row, channel));
  LONGS_EQUAL(9, offsetof(Row, state));
  LONGS_EQUAL(10, offsetof(Row, mode));
  LONGS_EQUAL(11, offsetof(Row, fault));
  LONGS_EQUAL(12, offsetof(Row, limited_by));
  LONGS_EQUAL(13, offsetof(Row, controller));
  LONGS_EQUAL(14, offsetof(Row, flags));
  LONGS_EQUAL(15, offsetof(Row, margin_selector));
  LONGS_EQUAL(16, offsetof(Row, reference));
  LONGS_EQUAL(20, offsetof(Row, model_m));
  LONGS_EQUAL(24, offsetof(Row, position_m));
  LONGS_EQUAL(28, offsetof(Row, demanded_W));
  LONGS_EQUAL(32, offsetof(Row, applied_W));
  LONGS_EQUAL(36, offsetof(Row, duty));
  LONGS_EQUAL(40, offsetof(Row, supply_V));
  LONGS_EQUAL(44, offsetof(Row, current_A));
  LONGS_EQUAL(48, offsetof(Row, resistance_Ohm));
  LONGS_EQUAL(52, offsetof(Row, resistance_age_s));
  LONGS_EQUAL(56, offsetof(Row, coldest_C));
  LONGS_EQUAL(60, offsetof(Row, hottest_C));
  LONGS_EQUAL(64, offsetof(Row, theta));
  LONGS_EQUAL(80, offsetof(Row, error_bound));
  LONGS_EQUAL(84, offsetof(Row, progress));
  LONGS_EQUAL(88, offsetof(Row, margin_used));
  LONGS_EQUAL(92, offsetof(Row, margin_measured));
  LONGS_EQUAL(96, offsetof(Row, margin_limit));
  LONGS_EQUAL(100, offsetof(Row, gain));
  LONGS_EQUAL(104, offsetof(Row, gain_selector));
  LONGS_EQUAL(105, offsetof(Row, result));
  LONGS_EQUAL(106, offsetof(Row, multiplexed_selector));
  LONGS_EQUAL(108, offsetof(Row, multiplexed_value));
}

TEST(Recording, TheHeaderIsTextThatDescribesTheRows) {
  const std::string start = file.substr(0, header_bytes);
  STRCMP_CONTAINS("supercoil flight recording, format 1, CRC-32 ", start.c_str());
  STRCMP_CONTAINS(
      "\nrow_bytes = 112\nrows = 4\nchannels = 2\nrate_Hz = 100\nfault = 30\n"
      "fault_name = \"over_temperature\"\nfault_channel = 2\n"
      "fault_time_ns = 5000000000\nrows_CRC32 = \"",
      start.c_str());
  BYTES_EQUAL('\n', start.back());
}

TEST(Recording, TheLongestHeaderFits) {
  recorder::Header header;
  header.rows = UINT32_MAX;
  header.channels = 16;
  header.rate_Hz = 9999.123456789012;
  header.fault = 255;
  header.fault_name = std::string(40, 'x');
  header.fault_channel = 15;
  header.fault_time_ns = INT64_MIN;
  header.rows_crc32 = 0xFFFFFFFF;
  header.program = std::string(40, '9');
  const std::string text = encode(header);
  LONGS_EQUAL(header_bytes, text.size());
  STRCMP_EQUAL("is cut off: 0 of 4294967295 rows are there", error(text).c_str());
}

TEST(Recording, TheCrcOfTwoPartsIsThatOfTheWhole) {
  const std::string_view text = "123456789";
  // The check value for CRC-32 in catalogues of CRCs.
  LONGS_EQUAL(0xCBF43926, storage::crc32(text));
  LONGS_EQUAL(storage::crc32(text), storage::crc32("1234", "56789"));
}

/// As if the header had been overwritten.
static recorder::Header header_of_rows(const std::vector<Row>& rows) {
  std::string file = file_of(rows);
  file[header_bytes - 10] ^= 1;
  return decode(file, Damaged::read)->header;
}

TEST(Recording, WithoutAHeaderTheFirstFaultThatLatchesIsTheRecordedOne) {
  for (Row& r : rows) {
    if (r.channel == 0) r.fault = static_cast<std::uint8_t>(Fault::sensor_stale);
  }
  const recorder::Header header = header_of_rows(rows);
  LONGS_EQUAL(30, header.fault);
  LONGS_EQUAL(1, header.fault_channel);
  CHECK(header.fault_time_ns == 5 * second_ns);
  rows.pop_back();
  const recorder::Header older = header_of_rows(rows);
  LONGS_EQUAL(11, older.fault);
  LONGS_EQUAL(0, older.fault_channel);
  CHECK(older.fault_time_ns == 4 * second_ns);
}

TEST(Recording, WithoutAHeaderAFaultAfterAResetLatches) {
  rows = {row(1 * second_ns, 0, Fault::sensor_stale), row(2 * second_ns, 0),
          row(3 * second_ns, 0, Fault::heater_open)};
  CHECK(header_of_rows(rows).fault_time_ns == 3 * second_ns);
}

TEST(Recording, EveryFlippedBitIsDetected) {
  for (std::size_t i = 0; i < file.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string changed = file;
      changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
      CHECK(!error(changed).empty());
    }
  }
}

TEST(Recording, EveryWrongLengthIsDetected) {
  for (std::size_t size = 0; size < file.size(); ++size)
    CHECK(!error(file.substr(0, size)).empty());
  CHECK(!error(file + '\0').empty());
}

TEST(Recording, EachKindOfDamageHasItsMessage) {
  STRCMP_EQUAL("is empty", error("").c_str());
  STRCMP_EQUAL("is cut off in its first line", error("supercoil fli").c_str());
  STRCMP_EQUAL(
      "is not a flight recording: it does not start with 'supercoil flight recording, format '",
      error("time_s,channel\n").c_str());
  STRCMP_CONTAINS("is not a flight recording", error(std::string(5000, '\0')).c_str());
  STRCMP_EQUAL("is cut off in its header: 300 of 512 bytes are there",
               error(file.substr(0, 300)).c_str());
  STRCMP_EQUAL("is cut off: 2 of 4 rows are there", error(file.substr(0, 512 + 300)).c_str());
  STRCMP_EQUAL("has 112 bytes more than were written", error(file + std::string(112, 'x')).c_str());
  std::string changed = file;
  changed[600] = '!';
  STRCMP_CONTAINS("is damaged: its rows have the CRC-32 ", error(changed).c_str());
  changed = file;
  changed[100] = '!';
  STRCMP_EQUAL("is damaged: its header is not as it was written", error(changed).c_str());
}

TEST(Recording, OtherFormatsAndRowSizesAreRefusedEvenWhenReadingDamaged) {
  std::string newer = file;
  newer[std::strlen("supercoil flight recording, format ")] = '2';
  for (const Damaged damaged : {Damaged::refuse, Damaged::read}) {
    STRCMP_EQUAL("is of format 2; this program reads format 1", error(newer, damaged).c_str());
    STRCMP_EQUAL("has rows of 120 bytes; this program reads rows of 112",
                 error(with("row_bytes = 112", "row_bytes = 120"), damaged).c_str());
  }
}

TEST(Recording, AWrongRowCountInTheHeaderIsRejected) {
  STRCMP_EQUAL("is cut off: 4 of 4000000000 rows are there",
               error(with("rows = 4", "rows = 4000000000")).c_str());
  STRCMP_EQUAL("has 112 bytes more than were written", error(with("rows = 4", "rows = 3")).c_str());
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"rows = 4", "rows = 18446744073709551615"},
           {"rows = 4", "rows = 0"},
           {"rows = 4", "rows = 4.5"},
           {"rows = 4", "rows = "},
           {"channels = 2", "channels = 17"},
           {"channels = 2", "channels = -1"},
           {"rate_Hz = 100", "rate_Hz = nan"},
           {"fault = 30", "fault = 300"},
           {"fault_channel = 2", "fault_channel = 0"},
           {"fault_name = \"over", "fault_name = over"},
       }) {
    STRCMP_EQUAL(("has an impossible header: " +
                  (from.starts_with("fault_name") ? to + "_temperature\"" : to))
                     .c_str(),
                 error(with(from, to)).c_str());
  }
  STRCMP_CONTAINS("has an impossible header: rows_CRC32 = ",
                  error(with("rows_CRC32 = \"", "rows_CRC32 = \"x")).c_str());
}

TEST(Recording, ATruncatedFileIsReadUpToTheLastWholeRow) {
  const auto read = decode(file.substr(0, header_bytes + 3 * sizeof(Row) + 50), Damaged::read);
  CHECK(read.has_value());
  STRCMP_EQUAL("is cut off: 3 of 4 rows are there", read->damage.c_str());
  CHECK(bytes_of(read->rows) == bytes_of(rows).substr(0, 3 * sizeof(Row)));
  LONGS_EQUAL(30, read->header.fault);
}

TEST(Recording, AllRowsAreReadWhenOneIsCorrupted) {
  std::string changed = file;
  changed[header_bytes + 112] = 1;
  const auto read = decode(changed, Damaged::read);
  LONGS_EQUAL(4, read->rows.size());
  CHECK(!read->damage.empty());
}

TEST(Recording, AppendedBytesAreNotRead) {
  LONGS_EQUAL(4, decode(file + file, Damaged::read)->rows.size());
}

TEST(Recording, WithADamagedHeaderTheFaultComesFromTheRows) {
  std::string changed = file;
  changed.replace(60, 300, 300, '\0');
  const auto read = decode(changed, Damaged::read);
  CHECK(read.has_value());
  STRCMP_EQUAL("is damaged: its header is not as it was written", read->damage.c_str());
  LONGS_EQUAL(4, read->rows.size());
  LONGS_EQUAL(30, read->header.fault);
  LONGS_EQUAL(1, read->header.fault_channel);
  LONGS_EQUAL(2, read->header.channels);
  CHECK(read->header.fault_time_ns == 5 * second_ns);
  CHECK(read->header.rate_Hz == 0.0);
}

TEST(Recording, WithoutAWholeRowThereIsNothingToRead) {
  STRCMP_EQUAL("has no whole row: it is cut off: 0 of 4 rows are there",
               error(file.substr(0, header_bytes + 100), Damaged::read).c_str());
  STRCMP_EQUAL("is cut off in its header: 100 of 512 bytes are there",
               error(file.substr(0, 100), Damaged::read).c_str());
}

TEST(Recording, ArbitraryContentIsReadSafely) {
  // With every byte of the header and of the rows changed, no more rows are read than exist.
  for (std::size_t i = 0; i < file.size(); ++i) {
    for (const char value : {'\0', '\xFF', '9', '\n', '"'}) {
      std::string changed = file;
      changed[i] = value;
      if (const auto read = decode(changed, Damaged::read)) {
        CHECK(read->rows.size() <= 4);
        for (const Row& r : read->rows)
          static_cast<void>(read->time_s(r));
      }
    }
  }
}

TEST(Recording, RowsAreSelectedByTimeAndChannel) {
  auto read = *decode(file, Damaged::refuse);
  auto some = read;
  select(some, -1.0, -0.5, -1);
  LONGS_EQUAL(2, some.rows.size());
  some = read;
  select(some, 0.0, 0.0, 1);
  LONGS_EQUAL(1, some.rows.size());
  LONGS_EQUAL(30, some.rows[0].fault);
  some = read;
  select(some, 1.0, 2.0, -1);
  LONGS_EQUAL(0, some.rows.size());
}
