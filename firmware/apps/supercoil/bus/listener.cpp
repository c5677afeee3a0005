#include "apps/supercoil/bus/listener.hpp"

#include <chrono>
#include <vector>

namespace supercoil::operating {

namespace {

constexpr std::size_t max_batch = 1024;
constexpr auto pause = std::chrono::milliseconds(5);

std::string loss_reason(hal::CanState state) {
  switch (state) {
    case hal::CanState::bus_off:
      return "the bus is off";
    case hal::CanState::down:
      return "the connection is lost";
    default:
      return {};
  }
}

}  // namespace

Listener::Listener(std::unique_ptr<hal::CanBus> bus, FrameHistory& frame_history)
    : bus_(std::move(bus)), frame_history_(&frame_history), thread_([this] { run(); }) {}

Listener::~Listener() {
  ending_ = true;
  thread_.join();
}

void Listener::run() {
  std::vector<hal::CanFrame> frames;
  while (!ending_) {
    frames.clear();
    hal::CanFrame frame;
    while (frames.size() < max_batch && bus_->receive(frame) == hal::Status::ok)
      frames.push_back(frame);
    frame_history_->add(frames);
    frame_history_->set_lost(loss_reason(bus_->state()));
    if (frames.size() < max_batch) std::this_thread::sleep_for(pause);
  }
}

}  // namespace supercoil::operating
