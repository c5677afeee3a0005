// One program that is connected to the simulated board's CAN bus.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/ip/tcp.hpp>

#include "can_client/socketcand.hpp"

namespace supercoil::host_sim {

class SocketcandServer;

/// Kept alive by its own pending operations; closed means nothing goes in or out any more.
class SocketcandClient : public std::enable_shared_from_this<SocketcandClient> {
 public:
  SocketcandClient(boost::asio::ip::tcp::socket socket, SocketcandServer& server)
      : socket_(std::move(socket)), server_(&server) {}

  void start();
  bool is_open() const { return socket_.is_open(); }
  /// A frame of the bus, if it wants them.
  void hear(std::string_view frame);
  /// Sends what waited for the pause to be over.
  void poll();
  void close();

 private:
  void read();
  void write();
  void send(std::string_view text);
  void obey(std::string_view element);
  void answer(std::string_view element);

  boost::asio::ip::tcp::socket socket_;
  SocketcandServer* server_;
  can_client::ElementReader reader_;
  std::array<char, 4096> buffer_{};
  std::string held_;  ///< frames, until frames_from_
  std::string waiting_;
  std::string in_flight_;
  bool opened_ = false;
  bool raw_ = false;
  std::chrono::steady_clock::time_point frames_from_;
};

}  // namespace supercoil::host_sim
