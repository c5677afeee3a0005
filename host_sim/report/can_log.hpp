// can.log: a run's frames as candump -L writes them, from can_client::simulation_epoch on.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::host_sim {

class CanLog {
 public:
  CanLog(const std::filesystem::path& path, std::string interface);

  void add(const hal::CanFrame& frame, hal::Time since_start);
  /// The error says why the file is not complete.
  Result<void> finish();

 private:
  std::ofstream out_;
  std::string interface_;
};

}  // namespace supercoil::host_sim
