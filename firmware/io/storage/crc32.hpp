// CRC-32 as in IEEE 802.3, gzip and PNG.
#pragma once

#include <cstdint>
#include <string_view>

namespace supercoil::storage {

/// Polynomial 0x04C11DB7 reflected, start and final xor 0xFFFFFFFF. Bit by bit, without a table: a
/// file of 600 bytes takes some microseconds, and it is read at start and when something is stored.
constexpr std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t rest = 0xFFFFFFFF;
  for (const char byte : bytes) {
    rest ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest >> 1) ^ ((rest & 1) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~rest;
}

// The check value that catalogues of CRCs give for this one.
static_assert(crc32("123456789") == 0xCBF43926);

}  // namespace supercoil::storage
