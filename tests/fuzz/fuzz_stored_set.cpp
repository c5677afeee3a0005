// What a board learned, read back from a disk that may have damaged it.
#include <string>

#include "fuzz/fuzz.hpp"
#include "storage/codec.hpp"
#include "storage/envelope.hpp"

using namespace supercoil;

namespace {

void read(std::string_view file) {
  const auto learned = storage::decode(file);
  if (!learned) {
    fuzz::require(!learned.error().text().empty(), "what is refused is refused with a reason");
    return;
  }
  fuzz::require(!board::check(*learned), "what is accepted is in range");
  const auto again = storage::decode(storage::encode(*learned));
  fuzz::require(again && *again == *learned, "what is written is read back to the bit");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text(data, size);
  read(text);
  // Behind a valid envelope: the fuzzer would hardly ever guess a CRC-32.
  const std::string sealed = storage::seal(text);
  const auto unsealed = storage::unseal(sealed);
  fuzz::require(!unsealed || unsealed->body == text, "an envelope gives back what is in it");
  read(sealed);
  return 0;
}
