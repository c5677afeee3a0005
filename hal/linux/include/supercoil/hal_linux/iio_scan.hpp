// A converter's inputs, converted by the kernel at a trigger's times into a buffer.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal/adc_channel.hpp"
#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/descriptor.hpp"
#include "supercoil/hal_linux/iio_device.hpp"
#include "supercoil/hal_linux/scan_element.hpp"

namespace supercoil::hal_linux {

/// Which inputs are converted together, and when.
struct ScanLocation {
  std::string device;               ///< IIO name, or the end of its device path with a slash
  std::vector<std::string> inputs;  ///< voltage0, …; each once
  std::string trigger;              ///< name of a trigger; empty: the one already set
  int length = 64;                  ///< scans that the kernel keeps; more than arrive between reads
  std::string root = "/sys/bus/iio/devices";
  std::string dev = "/dev";
};

/// A device set up for scans, not yet enabled.
struct ReadyScan {
  Descriptor device;
  Attribute enable;
  std::vector<ScanElement> inputs;  ///< in the order of ScanLocation::inputs
  ScanElement timestamp;
  std::size_t bytes = 0;  ///< of a scan
};

/// Disables the buffer, chooses elements, clock and trigger, and opens the device. Timestamps are
/// of CLOCK_MONOTONIC; a device without them is refused, as a value without its time is useless.
Result<ReadyScan> set_up_scan(const ScanLocation& place);

/// An enabled buffer. One thread uses it and its inputs. It is disabled when it ends.
class IioScan {
 public:
  static Result<std::unique_ptr<IioScan>> open(const ScanLocation& place);
  IioScan(ReadyScan ready, int length);
  IioScan(const IioScan&) = delete;
  IioScan& operator=(const IioScan&) = delete;
  ~IioScan();

  /// Input `index` of ScanLocation::inputs; lives as long as this. Its latest() comes from the
  /// newest scan: one read that never blocks and takes all that the kernel has kept.
  hal::AdcChannel& input(std::size_t index);

 private:
  class Input;

  void take_newest() noexcept;
  hal::Sample sample(std::size_t index) const noexcept;

  ReadyScan ready_;
  std::vector<std::byte> buffer_;
  std::vector<std::byte> newest_;
  hal::Time taken_{};
  hal::Status status_ = hal::Status::not_ready;
  std::vector<std::unique_ptr<Input>> inputs_;
};

}  // namespace supercoil::hal_linux
