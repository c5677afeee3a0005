// The physics between the firmware's outputs and its inputs: that of the simulated board, except
// that duties and levels come from the kernel's drivers and counts go to them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "chips.hpp"
#include "lines.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::rig {

struct PlantSettings {
  std::string i2c_bus = "/dev/i2c-0";
  int pwm_address = 0x40;
  int first_converter = 0x48;  ///< the supply's; position and current of each channel follow
  std::string lines = "/run/rig/lines";  ///< one folder for each line, by its name
  int channels = 2;                      ///< 1 to 4
  bool joint = false;  ///< the first two turn one joint; the first's position sensor is its angle's
  double rate_Hz = 1000.0;
  double supply_V = 12.0;
  double charge_pump_decay_ms = 20.0;
  double sense_filter_ms = 10.0;
  double position_noise_m = 5e-6;
  std::uint64_t seed = 1;
};

class Plant {
 public:
  explicit Plant(const PlantSettings& settings);

  /// The muscles move on to `now` with what was latched before, the converters show the result, and
  /// the firmware's outputs are latched again. `slow`: also the supply's converter and the lines
  /// that are not urgent.
  void step(hal::Time now, bool slow);

  host_sim::SimulatedBoard& board() { return board_; }
  const host_sim::SimulatedBoard& board() const { return board_; }
  std::size_t channels() const { return enable_lines_.size(); }

  // What is latched, besides what the board itself reports.
  bool stop_closed() const { return stop_closed_; }
  bool light() const { return light_; }
  int duty_4096(std::size_t channel) const { return duties_[channel]; }
  bool enabled(std::size_t channel) const { return board_.channel(channel).enable.high(); }

 private:
  host_sim::SimulatedBoard board_;
  Chip pwm_;
  ConversionRegister supply_;
  std::vector<ConversionRegister> positions_;
  std::vector<ConversionRegister> currents_;
  LineLevel heartbeat_line_;
  LineLevel stop_line_;
  LineLevel light_line_;
  std::vector<LineLevel> enable_lines_;
  std::vector<int> duties_;
  bool stop_closed_ = false;
  bool light_ = false;
};

}  // namespace supercoil::rig
