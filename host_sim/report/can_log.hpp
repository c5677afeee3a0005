// can.log: a run's frames as candump -L writes them.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <tl/expected.hpp>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::host_sim {

/// "(0000000012.345678) can0 281#A1B2C3": time in s, interface, identifier and bytes.
std::string candump_line(const hal::CanFrame& frame, hal::Time since_start,
                         const std::string& interface);

class CanLog {
 public:
  CanLog(const std::filesystem::path& path, std::string interface);

  void add(const hal::CanFrame& frame, hal::Time since_start);
  /// The error says why the file is not complete.
  tl::expected<void, std::string> finish();

 private:
  std::ofstream out_;
  std::string interface_;
};

}  // namespace supercoil::host_sim
