#include "apps/supercoil/bus/listener.hpp"

#include <chrono>
#include <vector>

namespace supercoil::operating {

namespace {

constexpr std::size_t most_at_once = 1024;
constexpr auto pause = std::chrono::milliseconds(5);

std::string why_lost(hal::CanState state) {
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

Listener::Listener(std::unique_ptr<hal::CanBus> bus, Recent& recent)
    : bus_(std::move(bus)), recent_(&recent), thread_([this] { run(); }) {}

Listener::~Listener() {
  ending_ = true;
  thread_.join();
}

void Listener::run() {
  std::vector<hal::CanFrame> frames;
  while (!ending_) {
    frames.clear();
    hal::CanFrame frame;
    while (frames.size() < most_at_once && bus_->receive(frame) == hal::Status::ok)
      frames.push_back(frame);
    recent_->add(frames);
    recent_->set_lost(why_lost(bus_->state()));
    if (frames.size() < most_at_once) std::this_thread::sleep_for(pause);
  }
}

}  // namespace supercoil::operating
