// The registers of the board's chips, which i2c-stub keeps: what the kernel's drivers write is read
// here, and what they read is written here.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace supercoil::rig {

/// A chip of an I²C bus, addressed past the driver that has claimed it. Throws std::system_error.
class Chip {
 public:
  Chip(const std::string& bus, int address);
  ~Chip();
  Chip(Chip&& other) noexcept : file_(other.file_) { other.file_ = -1; }
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;
  Chip& operator=(Chip&&) = delete;

  /// The first registers, in one transaction: enough of a PCA9685 for six outputs.
  std::array<std::uint8_t, 32> first_registers() const;
  void write_word(std::uint8_t at, std::uint16_t word) const;

 private:
  int file_;
};

/// In how many of the 4096 parts of a period an output is high, by a PCA9685's registers: MODE1 and
/// four of each output (section 7.3 of its data sheet).
int pca9685_high(const std::array<std::uint8_t, 32>& registers, int output);

/// A converter whose newest conversion is its register 0, as in an ADS1115.
class ConversionRegister {
 public:
  ConversionRegister(const std::string& bus, int address) : chip_(bus, address) {}
  /// Costs a transaction only if the counts are new.
  void show(std::int32_t counts);

 private:
  Chip chip_;
  std::int32_t shown_ = -0x8000000;
};

}  // namespace supercoil::rig
