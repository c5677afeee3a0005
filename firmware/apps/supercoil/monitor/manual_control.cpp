#include "apps/supercoil/monitor/manual_control.hpp"

#include <cmath>
#include <utility>

#include "text/refusal_words.hpp"

namespace supercoil::operating {

namespace {

/// Five renewals before a command expires by default.
constexpr auto renewal_period = std::chrono::milliseconds(50);
/// The board refuses a start whose time has passed when its loop gets it.
constexpr double start_after_s = 0.1;

bool heats(Verb verb) {
  return verb == Verb::position || verb == Verb::power || verb == Verb::identify ||
         verb == Verb::calibrate;
}

bool cools(Verb verb) {
  return verb == Verb::rest || verb == Verb::disarm;
}

}  // namespace

ManualControl::ManualControl(std::uint8_t node, OpenBus open_bus)
    : node_(node), open_bus_(std::move(open_bus)), thread_([this] { run(); }) {}

ManualControl::~ManualControl() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  woken_.notify_one();
  thread_.join();
}

ManualControl::Answer ManualControl::ask(Verb verb, double value) {
  return wait_for([this, verb, value] { return execute(verb, value); });
}

ManualControl::Answer ManualControl::prepare(const can_client::TunedPlace& place, double value) {
  return wait_for([this, place, value] {
    return with_commander([&](Commander& commander) -> Answer {
      const auto tuned = commander.prepare(place, value);
      if (!tuned) return tl::unexpected(tuned.error());
      return tuned->refusal;
    });
  });
}

Result<ManualControl::Sent> ManualControl::play(const std::vector<NextKnot>& knots, bool start) {
  Sent sent{0, {Refusal::none, PlaybackState::empty, 0, NAN}};
  const Answer answer = wait_for([&] { return send_knots(knots, start, sent); });
  if (!answer) return tl::unexpected(answer.error());
  sent.played.refusal = *answer;
  return sent;
}

ManualControl::Answer ManualControl::wait_for(Act act) {
  const std::lock_guard turn(request_mutex_);
  std::future<Answer> answer;
  {
    const std::lock_guard lock(mutex_);
    pending_.emplace(PendingCommand{std::move(act), {}});
    answer = pending_->answer.get_future();
  }
  woken_.notify_one();
  return answer.get();
}

ManualControl::Holding ManualControl::alive() {
  const std::lock_guard lock(mutex_);
  if (holding_) alive_ = Clock::now();
  return {holding_, holding_ ? "" : reason_};
}

void ManualControl::release_hold(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (!holding_) return;
  holding_ = false;
  reason_ = reason;
}

bool ManualControl::holds() const {
  const std::lock_guard lock(mutex_);
  return holding_;
}

/// After a board did not answer, the next request opens a new connection.
ManualControl::Answer ManualControl::with_commander(const std::function<Answer(Commander&)>& act) {
  if (!commander_) {
    auto bus = open_bus_();
    if (!bus) return tl::unexpected(bus.error());
    commander_ = std::make_unique<Commander>(std::move(*bus), node_);
  }
  Answer answer = act(*commander_);
  if (!answer) commander_.reset();
  return answer;
}

ManualControl::Answer ManualControl::command(Verb verb, double value) {
  return with_commander([&](Commander& commander) { return commander.ask(verb, value); });
}

ManualControl::Answer ManualControl::execute(Verb verb, double value) {
  Answer answer = command(verb, value);
  const bool obeyed = answer && *answer == Refusal::none;
  if (obeyed && heats(verb)) {
    const std::lock_guard lock(mutex_);
    holding_ = true;
    alive_ = Clock::now();
  } else if (obeyed && cools(verb)) {
    release_hold("cooled by a command");
  }
  return answer;
}

ManualControl::Answer ManualControl::send_knots(const std::vector<NextKnot>& knots, bool start,
                                                Sent& sent) {
  return with_commander([&](Commander& commander) -> Answer {
    const auto take = [&](const Commander::Played& played) -> Answer {
      if (!played) return tl::unexpected(played.error());
      sent.played = *played;
      return played->refusal;
    };
    for (const NextKnot& knot : knots) {
      if (!holds()) return Refusal::wrong_state;
      Answer answer =
          take(commander.add_knot(knot.after_s, {0.0, knot.position_m, knot.velocity_m_per_s}));
      if (!answer || *answer != Refusal::none) return answer;
      ++sent.knots;
      const std::lock_guard lock(mutex_);
      alive_ = Clock::now();
    }
    if (start) return holds() ? take(commander.start_at_once(start_after_s)) : Refusal::wrong_state;
    return knots.empty() ? take(commander.playback()) : Answer(Refusal::none);
  });
}

void ManualControl::renew() {
  {
    const std::lock_guard lock(mutex_);
    if (holding_ && Clock::now() - alive_ > page_timeout) {
      holding_ = false;
      reason_ = "expired: no page was alive for 1.5 s";
    }
  }
  if (!holds()) {
    if (commander_) commander_->drain();
    return;
  }
  const Answer answer = command(Verb::renew, 0.0);
  if (!answer) return release_hold("expired: " + answer.error().text());
  // Identification and calibration end by themselves; the board's state tells any other reason.
  if (*answer == Refusal::wrong_state) return release_hold("ended: the board stopped it");
  if (*answer != Refusal::none) release_hold("refused: " + std::string(refusal_words(*answer)));
}

void ManualControl::run() {
  Clock::time_point renewed{};
  for (;;) {
    std::optional<PendingCommand> order;
    {
      std::unique_lock lock(mutex_);
      woken_.wait_for(lock, renewal_period, [&] { return ending_ || pending_; });
      if (ending_) break;
      order = std::exchange(pending_, std::nullopt);
    }
    if (order) order->answer.set_value(order->act());
    // Also renew between orders in quick succession: a command to heat would expire.
    if (order && Clock::now() - renewed < renewal_period) continue;
    renewed = Clock::now();
    renew();
  }
  if (commander_) commander_->release();
}

}  // namespace supercoil::operating
