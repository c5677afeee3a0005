#include "apps/supercoil/bus/commander.hpp"

#include <array>
#include <cmath>
#include <random>
#include <thread>

namespace supercoil::operating {

namespace {

constexpr std::chrono::milliseconds answer_within{500};
/// Commands to heat expire after 250 ms by default; by then a renewal was sent three times.
constexpr std::array<std::chrono::milliseconds, 3> renewal_within{
    std::chrono::milliseconds(60), std::chrono::milliseconds(120), std::chrono::milliseconds(320)};
/// A lease lasts a second by default; one that may have run out is claimed again.
constexpr auto lease_lasts = std::chrono::milliseconds(400);
/// A board that sends the nearest value does so right after the answer.
constexpr auto nearest_within = std::chrono::milliseconds(50);
constexpr int claims_in_a_row = 3;
constexpr auto nap = std::chrono::milliseconds(1);

/// Whether obeying the command twice has the same effect as once.
bool may_come_twice(Verb verb) {
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
    std::chrono::milliseconds within) {
  const auto deadline = Clock::now() + within;
  hal::Status sent = bus_->send(frame);
  while (sent == hal::Status::busy && Clock::now() < deadline) {
    std::this_thread::sleep_for(nap);
    sent = bus_->send(frame);
  }
  if (sent != hal::Status::ok) return failure(std::string("cannot send on the bus: ") + text(sent));
  do {
    for (hal::CanFrame received; bus_->receive(received) == hal::Status::ok;) {
      if (const auto answer = parse(received)) return *answer;
    }
    std::this_thread::sleep_for(nap);
  } while (Clock::now() < deadline);
  return failure("no answer from node " + std::to_string(master_.node()) + " within 0.5 s",
                 std::errc::timed_out);
}

Commander::Answer Commander::exchange(const hal::CanFrame& frame,
                                      std::chrono::milliseconds within) {
  const auto parse = [&](const hal::CanFrame& received) -> std::optional<Refusal> {
    const auto answer = master_.receive_acknowledge(received);
    if (!answer) return std::nullopt;
    return answer->refusal;
  };
  return exchange<Refusal>(frame, parse, within);
}

Commander::Answer Commander::claim() {
  if (master_.holds_lease() && Clock::now() - lease_from_ <= lease_lasts) return Refusal::none;
  const bool is_new_claim = !master_.holds_lease();
  Answer answer = exchange(master_.claim(), answer_within);
  // Another master may have used the nonce first.
  for (int i = 0; i < claims_in_a_row && answer && *answer == Refusal::claim_again; ++i)
    answer = exchange(master_.claim(), answer_within);
  // A board of an older version takes the claim for a command without a lease.
  if (is_new_claim && answer && *answer == Refusal::no_lease) return Refusal::protocol_mismatch;
  return answer;
}

Commander::Answer Commander::command(Verb verb, double value) {
  if (verb != Verb::disarm) {
    Answer claimed = claim();
    if (!claimed || *claimed != Refusal::none) return claimed;
  }
  if (!may_come_twice(verb)) return exchange(master_.command(verb, value), answer_within);
  Answer answer;
  for (const auto within : renewal_within) {
    answer = exchange(master_.command(verb, value), within);
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
  const auto deadline = Clock::now() + nearest_within;
  do {
    for (hal::CanFrame received; bus_->receive(received) == hal::Status::ok;) {
      if (const auto nearest = can_client::receive_nearest(master_.node(), received))
        return *nearest;
    }
    std::this_thread::sleep_for(nap);
  } while (Clock::now() < deadline);
  return NAN;
}

template <class Content>
Result<Content> Commander::read_value(
    const hal::CanFrame& frame,
    const std::function<std::optional<Content>(const hal::CanFrame&)>& parse) {
  auto answer = exchange(frame, parse, answer_within);
  return answer ? answer : exchange(frame, parse, answer_within);
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
        answer_within);
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
        answer_within);
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
        answer_within);
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
  if (master_.holds_lease()) static_cast<void>(exchange(master_.release(), answer_within));
}

}  // namespace supercoil::operating
