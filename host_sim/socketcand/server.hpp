// The simulated board's CAN bus over TCP, for real CAN programs on a machine whose kernel has none.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::host_sim {

class SocketcandClient;

/// Speaks the socketcand protocol (open, rawmode, send, frame, echo) on loopback only. Everything
/// happens in poll(), which never waits. A client that does not read is closed before more than a
/// mebibyte waits for it.
class SocketcandServer {
 public:
  /// Called with each frame that a client sends.
  using Deliver = std::function<void(const hal::CanFrame&)>;

  /// port: 0 takes a free one. interface: the one that clients may open. The error names the port.
  static Result<std::unique_ptr<SocketcandServer>> listen(std::uint16_t port, std::string interface,
                                                          Deliver deliver);
  SocketcandServer(const boost::asio::ip::tcp::endpoint& endpoint, std::string interface,
                   Deliver deliver);
  SocketcandServer(const SocketcandServer&) = delete;
  SocketcandServer& operator=(const SocketcandServer&) = delete;
  ~SocketcandServer();

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  std::size_t clients() const { return clients_.size(); }
  /// Reads and sends what is pending: at most one buffer per client, so that no client can hold up
  /// the board.
  void poll();
  /// Sends a frame to all clients. at: since 1970.
  void send(const hal::CanFrame& frame, hal::Time at) { send(frame, at, nullptr); }

 private:
  friend class SocketcandClient;

  void accept();
  /// Without free descriptors every try fails at once: retrying within one poll would never end.
  void accept_later();
  /// Passes a client's frame to the board and to all other clients.
  void take(const hal::CanFrame& frame, const SocketcandClient& from);
  void send(const hal::CanFrame& frame, hal::Time at, const SocketcandClient* but);

  static constexpr std::size_t max_clients = 32;

  boost::asio::io_context io_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer retry_;
  std::string interface_;
  Deliver deliver_;
  /// The board's clock, which also stamps clients' frames: a bus has one clock, and the board's
  /// lags behind the machine's if the machine is too slow.
  hal::Time newest_{};
  std::vector<std::shared_ptr<SocketcandClient>> clients_;
};

}  // namespace supercoil::host_sim
