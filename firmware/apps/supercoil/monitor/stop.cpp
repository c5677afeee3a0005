#include "apps/supercoil/monitor/stop.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "can_client/master.hpp"

namespace supercoil::operating {

namespace {

using Clock = std::chrono::steady_clock;

/// If the bus loses a frame, the next one makes up for it.
constexpr int repetitions = 3;
constexpr auto repetition_pause = std::chrono::milliseconds(10);
constexpr auto max_busy_time = std::chrono::milliseconds(500);
/// Between stops: received frames are read, and a lost bus is reopened.
constexpr auto read_period = std::chrono::milliseconds(50);
constexpr auto retry_period = std::chrono::seconds(1);

}  // namespace

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
  const std::string failed = disarm_all();
  nlohmann::json result{{"nodes", frame_history_->nodes()}};
  if (!failed.empty()) result["error"] = failed;
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

std::string StopServer::disarm_all() {
  const std::string failed = send_disarm();
  if (failed.empty()) return {};
  bus_.reset();
  return send_disarm();
}

std::string StopServer::send_disarm() {
  if (std::string failed = open_bus(); !failed.empty()) return failed;
  const auto deadline = Clock::now() + max_busy_time;
  for (int i = 0; i < repetitions; ++i) {
    for (const std::uint8_t node : frame_history_->nodes()) {
      const hal::CanFrame frame = can_client::Master(node, 0).command(Verb::disarm, 0.0);
      hal::Status sent = bus_->send(frame);
      while (sent == hal::Status::busy && Clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        sent = bus_->send(frame);
      }
      if (sent != hal::Status::ok) return std::string("cannot send on the bus: ") + text(sent);
    }
    std::this_thread::sleep_for(repetition_pause);
  }
  return {};
}

}  // namespace supercoil::operating
