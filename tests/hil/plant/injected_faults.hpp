// Faults to inject, as text lines through a FIFO while the plant runs.
//
//   channel N wire_open|switch_stuck_on|enable_stuck_on|slack on|off
//   channel N short_Ohm OHM            across the muscle; 0: none
//   channel N position|current silent|frozen|loose|well
//   supply silent|frozen|loose|well    of its converter
//   supply_V VOLTS
//   pump_stuck on|off                  the supply's switch stays closed
//
// silent and frozen look alike here: an ADS1115 does not tell the age of its conversion.
#pragma once

#include <string>

#include "simulated_board/simulated_board.hpp"

namespace supercoil::rig {

/// What is wrong with the order; empty: it was obeyed.
std::string obey(const std::string& order, host_sim::SimulatedBoard& board, std::size_t channels);

/// A FIFO that is read without waiting. Throws std::system_error.
class Orders {
 public:
  explicit Orders(const std::string& path);
  ~Orders();
  Orders(const Orders&) = delete;
  Orders& operator=(const Orders&) = delete;

  /// The next complete line, or empty.
  std::string next();

 private:
  int file_;
  std::string received_;
};

}  // namespace supercoil::rig
