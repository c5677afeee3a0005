// Several simulated boards on one CAN bus.
#pragma once

#include <functional>
#include <vector>

#include "runner/simulation.hpp"

namespace supercoil::host_sim {

/// Each board hears the frames of all others. The boards must be stepped together and outlive it.
class SharedBus {
 public:
  /// A frame, and when its last bit was on the wire, from the scenario's time 0 on.
  using Listener = std::function<void(const hal::CanFrame& frame, hal::Time since_start)>;

  SharedBus(std::vector<Simulation*> boards, Listener listener);
  SharedBus(const SharedBus&) = delete;
  SharedBus& operator=(const SharedBus&) = delete;

  /// Delivers a frame that does not come from one of the boards.
  void deliver(const hal::CanFrame& frame);

 private:
  std::vector<Simulation*> boards_;
  Listener listener_;
  CanWire wire_;
};

}  // namespace supercoil::host_sim
