// A flight recording, as read by whoever looks for the cause of a fault.
#include <algorithm>
#include <string>

#include "fuzz/fuzz.hpp"
#include "recorder/recording.hpp"
#include "storage/crc32.hpp"

using namespace supercoil;
using recorder::Damaged;

namespace {

void read(std::string_view file) {
  const auto whole = recorder::decode(file, Damaged::refuse);
  auto any = recorder::decode(file, Damaged::read);
  fuzz::require(!whole || (any && any->damage.empty() && any->header == whole->header),
                "a whole recording is read the same way when damage is allowed");
  fuzz::require(whole || !whole.error().text().empty(), "what is refused is refused with a reason");
  if (!any) return;
  fuzz::require(whole.has_value() || !any->damage.empty(), "damage is said");
  fuzz::require(!any->rows.empty() && any->rows.size() <= file.size() / sizeof(Row),
                "there are as many rows as the file can hold");
  fuzz::require(any->header.channels >= 1 && any->header.channels <= 16, "channels are 1 to 16");
  std::size_t lines = 0;
  const auto written = recorder::to_csv(*any, [&](std::string_view part) -> Result<void> {
    lines += static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
    return {};
  });
  fuzz::require(written && lines == any->rows.size() + 1, "CSV has a line for each row");
  recorder::select(*any, -1.0, 1.0, 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = fuzz::text(data, size);
  read(bytes);
  if (size < sizeof(Row)) return 0;
  // Behind a header with the right CRCs: the fuzzer would hardly ever guess two CRC-32.
  recorder::Header header;
  header.rows = size / sizeof(Row);
  header.channels = 1 + data[0] % 16;
  header.rate_Hz = 1000.0;
  header.fault = 1;
  header.fault_name = "sensor_stale";
  const std::string_view rows = bytes.substr(0, header.rows * sizeof(Row));
  header.rows_crc32 = storage::crc32(rows);
  const std::string file = recorder::encode(header) + std::string(rows);
  const auto whole = recorder::decode(file, Damaged::refuse);
  fuzz::require(whole && whole->header == header, "what is written is read back");
  read(file);
  return 0;
}
