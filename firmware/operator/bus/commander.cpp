#include "operator/bus/commander.hpp"

#include <random>
#include <thread>

namespace supercoil::operating {

namespace {

constexpr auto answer_within = std::chrono::milliseconds(500);
/// A lease lasts a second by default; what may have run out is claimed again.
constexpr auto lease_lasts = std::chrono::milliseconds(400);
constexpr auto nap = std::chrono::milliseconds(1);

}  // namespace

Commander::Commander(std::unique_ptr<hal::CanBus> bus, std::uint8_t node)
    : bus_(std::move(bus)), master_(node, static_cast<std::uint16_t>(std::random_device()())) {}

void Commander::drain() {
  for (hal::CanFrame frame; bus_->receive(frame) == hal::Status::ok;) {
  }
}

Commander::Answer Commander::exchange(const hal::CanFrame& frame) {
  const auto deadline = Clock::now() + answer_within;
  hal::Status sent = bus_->send(frame);
  while (sent == hal::Status::busy && Clock::now() < deadline) {
    std::this_thread::sleep_for(nap);
    sent = bus_->send(frame);
  }
  if (sent != hal::Status::ok)
    return tl::unexpected(std::string("the bus does not take the command: ") + text(sent));
  do {
    for (hal::CanFrame heard; bus_->receive(heard) == hal::Status::ok;) {
      if (const auto answer = master_.hear(heard)) return answer->refusal;
    }
    std::this_thread::sleep_for(nap);
  } while (Clock::now() < deadline);
  return tl::unexpected("no answer from node " + std::to_string(master_.node()) + " within 0.5 s");
}

Commander::Answer Commander::command(Verb verb, double value) {
  const bool claims =
      verb != Verb::disarm && (!master_.holds_lease() || Clock::now() - lease_from_ > lease_lasts);
  if (claims) {
    Answer claimed = exchange(master_.claim());
    if (!claimed || *claimed != Refusal::none) return claimed;
  }
  return exchange(master_.command(verb, value));
}

tl::expected<Refusal, std::string> Commander::ask(Verb verb, double value) {
  drain();
  Answer answer = command(verb, value);
  // The lease ran out meanwhile, or commands were lost before this one: once more.
  if (answer && (*answer == Refusal::no_lease || *answer == Refusal::wrong_counter))
    answer = command(verb, value);
  if (answer && *answer == Refusal::none) lease_from_ = Clock::now();
  return answer;
}

void Commander::release() {
  if (master_.holds_lease()) static_cast<void>(exchange(master_.release()));
}

}  // namespace supercoil::operating
