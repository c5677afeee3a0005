#include "apps/supercoil/bus/commander.hpp"

#include <array>
#include <cmath>
#include <random>
#include <thread>

namespace supercoil::operating {

namespace {

constexpr std::chrono::milliseconds answer_timeout{500};
/// Commands to heat expire after 250 ms by default; by then a renewal was sent three times.
constexpr std::array<std::chrono::milliseconds, 3> renewal_timeouts{
    std::chrono::milliseconds(60), std::chrono::milliseconds(120), std::chrono::milliseconds(320)};
/// A lease lasts a second by default; one that may have run out is claimed again.
constexpr auto lease_duration = std::chrono::milliseconds(400);
/// A board that sends the nearest value does so right after the answer.
constexpr auto nearest_timeout = std::chrono::milliseconds(50);
constexpr int max_claims = 3;
constexpr auto poll_period = std::chrono::milliseconds(1);

/// Whether obeying the command twice has the same effect as once.
bool is_repeatable(Verb verb) {
  return verb == Verb::renew || verb == Verb::position || verb == Verb::power ||
         verb == Verb::disarm;
}

Refusal refusal_of(Refusal answer) {
  return answer;
}
template <class Answer>
Refusal refusal_of(const Answer& answer) {
  return answer.refusal;
}

}  // namespace

Commander::Commander(std::unique_ptr<hal::CanBus> bus, std::uint8_t node)
    : bus_(std::move(bus)), master_(node, static_cast<std::uint16_t>(std::random_device()())) {}

void Commander::drain() {
  for (hal::CanFrame frame; bus_->receive(frame) == hal::Status::ok;) {
  }
}

template <class Content>
Result<Content> Commander::exchange(
    const hal::CanFrame& frame,
    const std::function<std::optional<Content>(const hal::CanFrame&)>& parse,
    std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  hal::Status sent = bus_->send(frame);
  while (sent == hal::Status::busy && Clock::now() < deadline) {
    std::this_thread::sleep_for(poll_period);
    sent = bus_->send(frame);
  }
  if (sent != hal::Status::ok) return failure(std::string("cannot send on the bus: ") + text(sent));
  do {
    for (hal::CanFrame received; bus_->receive(received) == hal::Status::ok;) {
      if (const auto answer = parse(received)) return *answer;
    }
    std::this_thread::sleep_for(poll_period);
  } while (Clock::now() < deadline);
  return failure("no answer from node " + std::to_string(master_.node()) + " within 0.5 s",
                 std::errc::timed_out);
}

Commander::Answer Commander::exchange(const hal::CanFrame& frame,
                                      std::chrono::milliseconds timeout) {
  const auto parse = [&](const hal::CanFrame& received) -> std::optional<Refusal> {
    const auto answer = master_.receive_acknowledge(received);
    if (!answer) return std::nullopt;
    return answer->refusal;
  };
  return exchange<Refusal>(frame, parse, timeout);
}

Commander::Answer Commander::claim() {
  if (master_.holds_lease() && Clock::now() - lease_from_ <= lease_duration) return Refusal::none;
  const bool is_new_claim = !master_.holds_lease();
  Answer answer = exchange(master_.claim(), answer_timeout);
  // Another master may have used the nonce first.
  for (int i = 0; i < max_claims && answer && *answer == Refusal::claim_again; ++i)
    answer = exchange(master_.claim(), answer_timeout);
  // A board of an older version takes the claim for a command without a lease.
  if (is_new_claim && answer && *answer == Refusal::no_lease) return Refusal::protocol_mismatch;
  return answer;
}

Commander::Answer Commander::command(Verb verb, double value) {
  if (verb != Verb::disarm) {
    Answer claimed = claim();
    if (!claimed || *claimed != Refusal::none) return claimed;
  }
  if (!is_repeatable(verb)) return exchange(master_.command(verb, value), answer_timeout);
  Answer answer;
  for (const auto timeout : renewal_timeouts) {
    answer = exchange(master_.command(verb, value), timeout);
    if (answer) break;
  }
  return answer;
}

template <class Attempt>
auto Commander::retry_under_lease(const Attempt& attempt) {
  drain();
  auto answer = attempt();
  const auto is = [&](Refusal refusal) { return answer && refusal_of(*answer) == refusal; };
  // The lease has run out, or frames before this one were lost.
  if (is(Refusal::no_lease) || is(Refusal::wrong_counter)) answer = attempt();
  if (is(Refusal::none)) lease_from_ = Clock::now();
  return answer;
}

Result<Refusal> Commander::ask(Verb verb, double value) {
  return retry_under_lease([&] { return command(verb, value); });
}

double Commander::nearest() {
  const auto deadline = Clock::now() + nearest_timeout;
  do {
    for (hal::CanFrame received; bus_->receive(received) == hal::Status::ok;) {
      if (const auto nearest = can_client::receive_nearest(master_.node(), received))
        return *nearest;
    }
    std::this_thread::sleep_for(poll_period);
  } while (Clock::now() < deadline);
  return NAN;
}

template <class Content>
Result<Content> Commander::read_value(
    const hal::CanFrame& frame,
    const std::function<std::optional<Content>(const hal::CanFrame&)>& parse) {
  auto answer = exchange(frame, parse, answer_timeout);
  return answer ? answer : exchange(frame, parse, answer_timeout);
}

Commander::Setting Commander::read(std::uint8_t setting) {
  drain();
  return read_value<can_client::Master::Setting>(
      can_client::setting_read(master_.node(), setting), [&](const hal::CanFrame& frame) {
        auto answer = master_.receive_setting(frame, false);
        if (answer && answer->setting != setting) answer.reset();
        return answer;
      });
}

Commander::Setting Commander::write(std::uint8_t setting, double value) {
  return retry_under_lease([&]() -> Setting {
    const Answer claimed = claim();
    if (!claimed) return tl::unexpected(claimed.error());
    if (*claimed != Refusal::none) return can_client::Master::Setting{setting, *claimed, NAN};
    return exchange<can_client::Master::Setting>(
        master_.setting_write(setting, value),
        [&](const hal::CanFrame& frame) { return master_.receive_setting(frame, true); },
        answer_timeout);
  });
}

Commander::Tuned Commander::read_tuning(const can_client::TunedPlace& place) {
  drain();
  return read_value<can_client::TunedValue>(
      can_client::tuning_read(master_.node(), place), [&](const hal::CanFrame& frame) {
        return can_client::receive_tuning(master_.node(), place, frame);
      });
}

Commander::Tuned Commander::prepare(const can_client::TunedPlace& place, double value) {
  return retry_under_lease([&]() -> Tuned {
    const Answer claimed = claim();
    if (!claimed) return tl::unexpected(claimed.error());
    if (*claimed != Refusal::none) return can_client::TunedValue{*claimed, NAN, 0};
    return exchange<can_client::TunedValue>(
        master_.tuning_write(place, value),
        [&](const hal::CanFrame& frame) { return master_.receive_tuning(place, frame); },
        answer_timeout);
  });
}

Commander::Played Commander::play(const std::function<hal::CanFrame()>& frame) {
  return retry_under_lease([&]() -> Played {
    const Answer claimed = claim();
    if (!claimed) return tl::unexpected(claimed.error());
    if (*claimed != Refusal::none)
      return can_client::Played{*claimed, PlaybackState::empty, 0, NAN};
    return exchange<can_client::Played>(
        frame(), [&](const hal::CanFrame& received) { return master_.receive_played(received); },
        answer_timeout);
  });
}

Commander::Played Commander::add_knot(double after_s, const control::Knot& knot) {
  return play([&] { return master_.knot(after_s, knot.position_m, knot.velocity_m_per_s); });
}

Commander::Played Commander::start_at_once(double after_s) {
  return play([&] { return master_.play_at_once(after_s); });
}

Commander::Played Commander::start_at_sync(std::uint8_t sync, double after_s) {
  return play([&] { return master_.play_at_sync(sync, after_s); });
}

Commander::Played Commander::playback() {
  return play([&] { return master_.play_never(); });
}

hal::Status Commander::send_sync(std::uint8_t number, double master_time_s) {
  return bus_->send(can_client::sync(number, master_time_s));
}

Result<KnownMuscle> Commander::muscle() {
  drain();
  KnownMuscle known{};
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto quantity = static_cast<std::uint8_t>(i);
    const auto value = read_value<double>(
        can_client::muscle_read(master_.node(), quantity), [&](const hal::CanFrame& frame) {
          return can_client::receive_muscle(master_.node(), quantity, frame);
        });
    if (!value) return tl::unexpected(value.error());
    known[i] = *value;
  }
  return known;
}

void Commander::release() {
  if (master_.holds_lease()) static_cast<void>(exchange(master_.release(), answer_timeout));
}

}  // namespace supercoil::operating
