#include "runner/shared_bus.hpp"

#include <utility>

namespace supercoil::host_sim {

SharedBus::SharedBus(std::vector<Simulation*> boards, Listener listener)
    : boards_(std::move(boards)), listener_(std::move(listener)) {
  for (Simulation* sender : boards_) {
    sender->join_bus([this, sender](const hal::CanFrame& frame) {
      const hal::Time since_start = frame.received - sender->start();
      for (Simulation* board : boards_) {
        if (board == sender) continue;
        hal::CanFrame received = frame;
        received.received = since_start + board->start();
        board->bus()->deliver(received);
      }
      listener_(frame, since_start);
    });
    sender->bus()->share(wire_, sender->start());
  }
}

void SharedBus::deliver(const hal::CanFrame& frame) {
  for (Simulation* board : boards_)
    board->bus()->deliver(frame);
}

}  // namespace supercoil::host_sim
