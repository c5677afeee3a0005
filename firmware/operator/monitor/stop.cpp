#include "operator/monitor/stop.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include <nlohmann/json.hpp>

#include "can_client/master.hpp"

namespace supercoil::operating {

namespace {

/// A frame that the bus lost is made up for by the next one.
constexpr int repetitions = 3;
constexpr auto between = std::chrono::milliseconds(10);
constexpr auto at_most = std::chrono::milliseconds(500);

}  // namespace

StopServer::StopServer(Access access, Hand::OpenBus open_bus, const Recent& recent,
                       std::function<void()> let_go)
    : access_(std::move(access)),
      open_bus_(std::move(open_bus)),
      recent_(&recent),
      let_go_(std::move(let_go)) {
  // Two, so that one who only opens a connection does not keep the other out.
  server_.new_task_queue = [] { return new httplib::ThreadPool(2); };
  take_port_alone(server_);
  server_.set_read_timeout(1);
  server_.set_keep_alive_max_count(1);
  server_.set_payload_max_length(256);
  server_.Post("/stop", [this](const httplib::Request& request, httplib::Response& response) {
    stop(request, response);
  });
}

tl::expected<std::unique_ptr<StopServer>, std::string> StopServer::start(
    const Access& access, Hand::OpenBus open_bus, const Recent& recent,
    std::function<void()> let_go) {
  std::unique_ptr<StopServer> server(
      new StopServer(access, std::move(open_bus), recent, std::move(let_go)));
  const int next = access.port + 1;
  server->port_ = server->server_.bind_to_port(access.host, next)
                      ? next
                      : server->server_.bind_to_any_port(access.host);
  if (server->port_ <= 0) return tl::unexpected(access.host + ": no port for STOP can be had");
  server->thread_ = std::make_unique<ServerThread>(server->server_);
  return server;
}

std::string StopServer::disarm_all() {
  const std::lock_guard lock(mutex_);
  if (bus_ && bus_->state() == hal::CanState::down) bus_.reset();
  if (!bus_) {
    auto bus = open_bus_();
    if (!bus) return bus.error();
    bus_ = std::move(*bus);
  }
  const auto deadline = std::chrono::steady_clock::now() + at_most;
  for (int i = 0; i < repetitions; ++i) {
    for (const std::uint8_t node : recent_->nodes()) {
      const hal::CanFrame frame = can_client::Master(node, 0).command(Verb::disarm, 0.0);
      hal::Status sent = bus_->send(frame);
      while (sent == hal::Status::busy && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        sent = bus_->send(frame);
      }
      if (sent != hal::Status::ok) return std::string("the bus does not take it: ") + text(sent);
    }
    std::this_thread::sleep_for(between);
  }
  // What came meanwhile is nobody's.
  for (hal::CanFrame heard; bus_->receive(heard) == hal::Status::ok;) {
  }
  return {};
}

void StopServer::stop(const httplib::Request& request, httplib::Response& response) {
  // The page's own port is another origin than this one.
  if (comes_from_our_page(access_, request))
    response.set_header("Access-Control-Allow-Origin", request.get_header_value("Origin"));
  nlohmann::json told;
  if (const std::string refused = refuse_to_stop(access_, request, port_); !refused.empty()) {
    response.status = 403;
    told["error"] = refused;
  } else {
    let_go_();
    const std::string failed = disarm_all();
    told["nodes"] = recent_->nodes();
    if (!failed.empty()) {
      response.status = 502;
      told["error"] = failed;
    }
  }
  response.set_content(told.dump(), "application/json");
}

}  // namespace supercoil::operating
