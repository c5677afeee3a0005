// CRC-32 as in IEEE 802.3, gzip and PNG.
#pragma once

#include <cstdint>
#include <string_view>

#include <boost/crc.hpp>

namespace supercoil::storage {

inline std::uint32_t crc32(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

}  // namespace supercoil::storage
