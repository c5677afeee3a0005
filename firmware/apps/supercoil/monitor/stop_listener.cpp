#include "apps/supercoil/monitor/stop_listener.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <sys/resource.h>

#include "apps/supercoil/monitor/stop_connection.hpp"

namespace supercoil::operating {

using boost::asio::ip::tcp;

namespace {

/// At 10,000 connections a second each still has 25 ms for its request; a browser on this machine
/// took 1 ms.
constexpr std::size_t max_connections = 256;
constexpr auto retry_after = std::chrono::milliseconds(5);

}  // namespace

Result<std::unique_ptr<StopListener>> StopListener::open(const std::string& host, int port) {
  auto listener = std::make_unique<StopListener>();
  boost::system::error_code error = listener->listen(host, port);
  if (error) error = listener->listen(host, 0);
  if (error) return failure(host + ": no port available for STOP: " + error.message());
  return listener;
}

boost::system::error_code StopListener::listen(const std::string& host, int port) {
  boost::system::error_code error;
  const auto places =
      tcp::resolver(io_).resolve(host, std::to_string(port), tcp::resolver::passive, error);
  if (error) return error;
  const tcp::endpoint endpoint = places.begin()->endpoint();
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(boost::asio::socket_base::max_listen_connections, error);
  if (!error) port_ = acceptor_.local_endpoint(error).port();
  return error;
}

void take_precedence() {
  constexpr int nice = -10;
  const id_t this_thread = 0;
  if (::getpriority(PRIO_PROCESS, this_thread) > nice)
    static_cast<void>(::setpriority(PRIO_PROCESS, this_thread, nice));
}

void StopListener::start(Take take) {
  take_ = std::move(take);
  accept();
  thread_ = std::thread([this] {
    take_precedence();
    io_.run();
  });
}

StopListener::~StopListener() {
  io_.stop();
  if (thread_.joinable()) thread_.join();
}

void StopListener::accept() {
  acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
    std::erase_if(connections_, [](const auto& connection) { return !connection->is_open(); });
    if (error) return accept_later();
    connections_.push_back(std::make_shared<StopConnection>(std::move(socket), take_));
    connections_.back()->start();
    if (connections_.size() > max_connections) close_oldest();
    accept();
  });
}

/// With no free descriptor every accept fails: closing one of our connections makes room.
void StopListener::accept_later() {
  if (!connections_.empty()) close_oldest();
  retry_.expires_after(retry_after);
  retry_.async_wait([this](boost::system::error_code) { accept(); });
}

/// Only those without a complete request: a requested STOP is obeyed whether answered or not.
void StopListener::close_oldest() {
  auto oldest = std::find_if(connections_.begin(), connections_.end(),
                             [](const auto& connection) { return !connection->has_request(); });
  if (oldest == connections_.end()) oldest = connections_.begin();
  (*oldest)->close();
  connections_.erase(oldest);
}

}  // namespace supercoil::operating
