#include "apps/supercoil/monitor/stop.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "loop/snapshot.hpp"

namespace supercoil::operating {

namespace {

/// If the bus loses a frame, the next one makes up for it.
constexpr int repetitions = 3;
constexpr auto repetition_pause = std::chrono::milliseconds(10);
/// From the first frame. A board that is present takes a few milliseconds; the page waits for 500.
constexpr auto confirm_within = std::chrono::milliseconds(300);
constexpr auto poll_pause = std::chrono::milliseconds(1);
/// Between stops: received frames are read, and a lost bus is reopened.
constexpr auto read_period = std::chrono::milliseconds(50);
constexpr auto retry_period = std::chrono::seconds(1);

/// Sent by the node: disarmed, or cold because of a fault.
bool reports_off(std::uint8_t node, const hal::CanFrame& frame) {
  if (frame.id != can_client::status_id(node) || frame.length != can::message::status.length)
    return false;
  const auto state = can::Reader<can::message::status>(frame).get<State>("state");
  return state == State::disarmed || state == State::fault;
}

bool acknowledges(can_client::Master& master, const hal::CanFrame& frame) {
  const auto answer = master.receive_acknowledge(frame);
  return answer && answer->opcode == static_cast<std::uint8_t>(Verb::disarm) &&
         answer->refusal == Refusal::none;
}

/// "node 2 did not confirm it"
std::string unconfirmed_text(const std::vector<can_client::Master>& unconfirmed) {
  std::string text = unconfirmed.size() == 1 ? "node " : "nodes ";
  for (const can_client::Master& master : unconfirmed)
    text += (&master == &unconfirmed.front() ? "" : ", ") + std::to_string(master.node());
  return text + " did not confirm it";
}

}  // namespace

std::vector<std::uint16_t> StopServer::received_ids() {
  std::vector<std::uint16_t> ids;
  for (std::uint8_t node = 1; node <= can::max_nodes; ++node)
    ids.insert(ids.end(), {can_client::acknowledge_id(node), can_client::status_id(node)});
  return ids;
}

StopServer::StopServer(Access access, ManualControl::OpenBus open_bus,
                       const FrameHistory& frame_history, std::function<void()> release_hold)
    : access_(std::move(access)),
      new_bus_(std::move(open_bus)),
      frame_history_(&frame_history),
      release_hold_(std::move(release_hold)) {}

Result<std::unique_ptr<StopServer>> StopServer::start(const Access& access,
                                                      ManualControl::OpenBus open_bus,
                                                      const FrameHistory& frame_history,
                                                      std::function<void()> release_hold) {
  auto listener = StopListener::open(access.host, access.port + 1);
  if (!listener) return tl::unexpected(listener.error());
  std::unique_ptr<StopServer> server(
      new StopServer(access, std::move(open_bus), frame_history, std::move(release_hold)));
  server->listener_ = std::move(*listener);
  server->thread_ = std::thread([server = server.get()] { server->run(); });
  server->listener_->start([server = server.get()](const auto& request, const auto& answer) {
    server->take(request, answer);
  });
  return server;
}

/// The listener is destroyed last: answers need it.
StopServer::~StopServer() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  woken_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void StopServer::take(const httplib::Request& request, const StopListener::Answer& answer) {
  // The page's port is a different origin from this one.
  const std::string origin =
      is_same_origin(access_, request) ? request.get_header_value("Origin") : std::string();
  if (request.method != "POST" || request.path != "/stop") return answer({404, origin, "{}"});
  if (const std::string refused = refuse_to_stop(access_, request, port()); !refused.empty())
    return answer({403, origin, nlohmann::json{{"error", refused}}.dump()});
  release_hold_();
  {
    const std::lock_guard lock(mutex_);
    pending_.push_back({answer, origin});
  }
  woken_.notify_one();
}

void StopServer::run() {
  take_precedence();
  for (;;) {
    std::vector<PendingStop> pending;
    {
      std::unique_lock lock(mutex_);
      woken_.wait_for(lock, read_period, [&] { return ending_ || !pending_.empty(); });
      if (ending_) return;
      pending.swap(pending_);
    }
    if (pending.empty()) {
      maintain_bus();
    } else {
      stop(pending);
    }
  }
}

/// The next stop answers all requests that came during a stop together.
void StopServer::stop(const std::vector<PendingStop>& pending) {
  const std::vector<std::uint8_t> nodes = frame_history_->nodes();
  const std::string failed = disarm(nodes);
  const nlohmann::json result =
      failed.empty() ? nlohmann::json{{"nodes", nodes}} : nlohmann::json{{"error", failed}};
  for (const auto& [answer, origin] : pending)
    answer({failed.empty() ? 200 : 502, origin, result.dump()});
}

std::string StopServer::open_bus() {
  if (bus_ && bus_->state() != hal::CanState::down) return {};
  bus_.reset();
  auto bus = new_bus_();
  if (!bus) return bus.error().text();
  bus_ = std::move(*bus);
  return {};
}

/// A silent loss of the bus only shows when reading; the frames are dropped.
void StopServer::maintain_bus() {
  if (bus_) {
    for (hal::CanFrame dropped; bus_->receive(dropped) == hal::Status::ok;) {
    }
  } else if (Clock::now() >= next_try_) {
    open_bus();
    next_try_ = Clock::now() + retry_period;
  }
}

std::string StopServer::disarm(const std::vector<std::uint8_t>& nodes) {
  Masters unconfirmed;
  for (const std::uint8_t node : nodes)
    unconfirmed.emplace_back(node, 0);
  if (const std::string failed = send_disarm(unconfirmed); !failed.empty()) {
    bus_.reset();
    if (std::string again = send_disarm(unconfirmed); !again.empty()) return again;
  }
  return unconfirmed.empty() ? std::string() : unconfirmed_text(unconfirmed);
}

std::string StopServer::send_disarm(Masters& unconfirmed) {
  if (std::string failed = open_bus(); !failed.empty()) return failed;
  maintain_bus();
  std::vector<hal::CanFrame> frames;
  for (can_client::Master& master : unconfirmed)
    frames.push_back(master.command(Verb::disarm, 0.0));
  const auto deadline = Clock::now() + confirm_within;
  for (int i = 0; i < repetitions; ++i) {
    for (const hal::CanFrame& frame : frames) {
      if (std::string failed = send_until(frame, deadline); !failed.empty()) return failed;
    }
    receive_until(unconfirmed, Clock::now() + repetition_pause, false);
  }
  while (!unconfirmed.empty() && Clock::now() < deadline) {
    if (bus_->state() == hal::CanState::down) return "the bus was lost";
    receive_until(unconfirmed, Clock::now() + poll_pause, true);
  }
  return {};
}

std::string StopServer::send_until(const hal::CanFrame& frame, Clock::time_point deadline) {
  hal::Status sent = bus_->send(frame);
  while (sent == hal::Status::busy && Clock::now() < deadline) {
    std::this_thread::sleep_for(poll_pause);
    sent = bus_->send(frame);
  }
  return sent == hal::Status::ok ? "" : std::string("cannot send on the bus: ") + text(sent);
}

/// also_by_status: not at first, when a Status may still be from before the disarm.
void StopServer::receive_until(Masters& unconfirmed, Clock::time_point end, bool also_by_status) {
  while (Clock::now() < end) {
    for (hal::CanFrame frame;
         bus_->state() != hal::CanState::down && bus_->receive(frame) == hal::Status::ok;) {
      std::erase_if(unconfirmed, [&](can_client::Master& master) {
        return acknowledges(master, frame) || (also_by_status && reports_off(master.node(), frame));
      });
    }
    std::this_thread::sleep_for(poll_pause);
  }
}

}  // namespace supercoil::operating
