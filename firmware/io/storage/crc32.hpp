// CRC-32 as in IEEE 802.3, gzip and PNG.
#pragma once

#include <cstdint>
#include <string_view>

#include <boost/crc.hpp>

namespace supercoil::storage {

/// Over the bytes of first, then those of second.
inline std::uint32_t crc32(std::string_view first, std::string_view second = {}) {
  boost::crc_32_type crc;
  crc.process_bytes(first.data(), first.size());
  crc.process_bytes(second.data(), second.size());
  return crc.checksum();
}

}  // namespace supercoil::storage
