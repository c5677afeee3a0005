#include "chips.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace supercoil::rig {

namespace {

void transfer(int file, bool read, std::uint8_t command, unsigned size, i2c_smbus_data& data) {
  i2c_smbus_ioctl_data request{};
  request.read_write = read ? I2C_SMBUS_READ : I2C_SMBUS_WRITE;
  request.command = command;
  request.size = size;
  request.data = &data;
  if (ioctl(file, I2C_SMBUS, &request) != 0)
    throw std::system_error(errno, std::generic_category(), "I2C transaction");
}

}  // namespace

Chip::Chip(const std::string& bus, int address) : file_(open(bus.c_str(), O_RDWR | O_CLOEXEC)) {
  if (file_ < 0 || ioctl(file_, I2C_SLAVE_FORCE, static_cast<long>(address)) != 0)
    throw std::system_error(errno, std::generic_category(), bus);
}

Chip::~Chip() {
  if (file_ >= 0) close(file_);
}

std::array<std::uint8_t, 32> Chip::first_registers() const {
  i2c_smbus_data data{};
  std::array<std::uint8_t, 32> registers{};
  data.block[0] = static_cast<std::uint8_t>(registers.size());
  transfer(file_, true, 0, I2C_SMBUS_I2C_BLOCK_DATA, data);
  std::copy_n(data.block + 1, registers.size(), registers.begin());
  return registers;
}

void Chip::write_word(std::uint8_t at, std::uint16_t word) const {
  i2c_smbus_data data{};
  data.word = word;
  transfer(file_, false, at, I2C_SMBUS_WORD_DATA, data);
}

int pca9685_high(const std::array<std::uint8_t, 32>& registers, int output) {
  constexpr int asleep = 0x10;  // in MODE1: its oscillator is stopped
  constexpr int always = 0x10;  // in the upper byte: all of the period
  const std::size_t first = 6 + 4 * static_cast<std::size_t>(output);
  const auto moment = [&](std::size_t at) {
    return registers.at(at) + 256 * (registers.at(at + 1) & 0x0f);
  };
  if ((registers[0] & asleep) != 0 || (registers.at(first + 3) & always) != 0) return 0;
  if ((registers.at(first + 1) & always) != 0) return 4096;
  return (moment(first + 2) - moment(first) + 4096) % 4096;
}

void ConversionRegister::show(std::int32_t counts) {
  if (counts == shown_) return;
  shown_ = counts;
  // SMBus sends the lower byte first, the chip expects the upper one.
  const auto word = static_cast<std::uint16_t>(std::clamp(counts, -32768, 32767));
  chip_.write_word(0, static_cast<std::uint16_t>(word << 8 | word >> 8));
}

}  // namespace supercoil::rig
