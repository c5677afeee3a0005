// Converters that the kernel reads into a buffer.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal_linux/iio_scan.hpp"
#include "supercoil/hal_linux/machine.hpp"

#include "config/wiring.hpp"

namespace supercoil::linux_board {

/// Opens the captures of a board: each device once, with all of its inputs that the board needs.
class Captures {
 public:
  Captures(const config::BoardWiring& wiring, hal_linux::Machine machine);

  /// Opens one of these inputs. A device's capture runs until the last of its inputs is destroyed;
  /// all inputs of a device belong to one thread.
  Result<std::unique_ptr<hal::AdcChannel>> open(const config::ConverterAddress& input);

 private:
  using Scan = Result<std::shared_ptr<hal_linux::IioScan>>;

  void add(const config::ConverterAddress& input);
  Scan& scan_of(const std::string& device);

  std::map<std::string, hal_linux::ScanLocation> demanded_;  ///< by device
  std::map<std::string, Scan> opened_;
  hal_linux::Machine machine_;
};

}  // namespace supercoil::linux_board
