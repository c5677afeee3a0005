// May this board be hot at all? Detects the faults that concern every channel.
#pragma once

#include <cstdint>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/digital_line.hpp"

#include "board/measurement.hpp"
#include "supervisor/detectors/limits.hpp"
#include "supervisor/detectors/liveness.hpp"
#include "supervisor/supervision.hpp"
#include "supervisor/verdict.hpp"

namespace supercoil {

/// The board's inputs of this tick.
struct BoardInputs {
  board::Measured supply;  ///< in V
  hal::Level stop_circuit;
  double late_s = 0.0;       ///< how late this tick woke
  std::int64_t skipped = 0;  ///< periods that the last tick overran
  bool lines_ok = true;      ///< every line of the last tick was set
  std::uint32_t telemetry_heartbeats = 0;
  hal::CanState bus = hal::CanState::active;
  bool node_conflict = false;  ///< another board sends as a node of this one
  bool configuration_changed = false;
  bool self_test_failed = false;
  int self_test_cut = 1;  ///< the cut that failed: 1 the charge pump, 2 an enable line
};

/// All detectors that concern the whole board.
class BoardSupervisor {
 public:
  BoardSupervisor(const BoardSupervisor&) = delete;
  BoardSupervisor& operator=(const BoardSupervisor&) = delete;
  BoardSupervisor(const BoardSupervision& settings, double step_s);

  /// One tick: the fault of this tick, or none.
  Fault step(const BoardInputs& e);
  const Verdict& verdict() const { return verdict_; }

 private:
  Verdict verdict_;
  detectors::Flag stop_;
  detectors::Flag lines_;
  detectors::Flag configuration_;
  detectors::Flag self_test_;
  detectors::Below under_;
  detectors::Above over_;
  detectors::ConsecutiveCount late_in_a_row_;
  detectors::ConsecutiveCount overruns_;
  detectors::StalledCounter telemetry_;
  detectors::TimedFlag bus_off_;
  detectors::TimedFlag bus_passive_;
  detectors::Flag node_conflict_;
  double late_s_;
};

}  // namespace supercoil
