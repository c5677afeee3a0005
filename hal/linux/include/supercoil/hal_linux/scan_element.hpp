// How one value lies in a scan of the kernel's IIO buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "supercoil/hal/error.hpp"

namespace supercoil::hal_linux {

/// What scan_elements/in_…_type says: "le:s12/16>>4".
struct ScanType {
  bool big_endian = false;
  bool is_signed = false;
  int bits = 0;          ///< significant ones, 1 to storage_bits
  int storage_bits = 0;  ///< 8, 16, 32 or 64
  int shift = 0;         ///< to the right, before the bits are taken

  std::size_t bytes() const { return static_cast<std::size_t>(storage_bits) / 8; }
  friend bool operator==(const ScanType&, const ScanType&) = default;
};

/// Refuses everything that the kernel's documentation does not allow, and repeated values ("X2").
Result<ScanType> parse_scan_type(std::string_view text);

/// The value in the type's bytes() at `bytes`. 64-bit unsigned values in the upper half wrap.
std::int64_t value_of(const ScanType& type, const std::byte* bytes) noexcept;

/// One value's place in a scan.
struct ScanElement {
  int index = 0;  ///< in_…_index: their order
  ScanType type;
  std::size_t offset = 0;  ///< bytes from the scan's start; lay_out() finds it
};

/// Sets the offsets of a scan's elements and returns the bytes of a whole scan. Each is aligned to
/// its own size, and the scan to the largest, as the kernel does.
std::size_t lay_out(std::vector<ScanElement>& elements);

}  // namespace supercoil::hal_linux
