// What the plant sees, as text lines for the host, which judges it there: a witness inside the
// board would die with its kernel. Integers, separated by one space; the first word says what a
// line is.
//
//   # text            what was started, with its settings
//   T time_us text    an injected fault; when it was refused, also the reason
//   S time_us steps missed mean_us max_us late_us
//       of the plant itself, once a second: steps since the last line, steps that were left out,
//       how long a step took, and how late the latest woke
//   W time_us edges edge_us stop light closed  then for each channel
//             enable duty power_mW position_um rise_mK current_mA
//       at every change of stop, light, closed, an enable, or a duty from or to 0, else every 10 ms
//       time_us      CLOCK_MONOTONIC of the board, when outputs were read
//       edges        of the heartbeat so far, as the charge pump got them (none while stop is 0)
//       edge_us      when the last of them was seen, at most a step late; 0: none yet
//       stop         1: the stop circuit is closed. Read every 10 ms, as is light
//       closed       1: the charge pump holds the supply's switch closed
//       enable       level of the channel's enable line
//       duty         parts of 4096 that the PWM chip's registers stand for
//       power_mW     true heat in the muscle
//       position_um  true contraction
//       rise_mK      true temperature above the air's
//       current_mA   true current, of all that the switch carries
#pragma once

#include <cstdint>
#include <string>

#include "plant.hpp"

namespace supercoil::rig {

class Witness {
 public:
  /// Throws std::system_error. Empty: standard output.
  explicit Witness(const std::string& path);
  ~Witness();
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;

  void note(const std::string& line);
  void look(const Plant& plant, hal::Time now);
  void step_took(hal::Time now, hal::Duration took, hal::Duration late, int missed);

 private:
  void write_line(const char* text, std::size_t length) const;

  int file_;
  std::uint64_t edges_ = 0;
  hal::Time edge_{};
  std::uint64_t state_ = ~0ULL;
  hal::Time next_{};

  hal::Time counted_since_{};
  hal::Duration sum_{};
  hal::Duration max_{};
  hal::Duration latest_{};
  long steps_ = 0;
  long missed_ = 0;
};

}  // namespace supercoil::rig
