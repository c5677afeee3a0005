// One program that is connected to the simulated board's CAN bus.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "can_client/socketcand.hpp"

namespace supercoil::host_sim {

class SocketcandServer;

/// Kept alive by its own pending operations; closed means nothing goes in or out any more.
class SocketcandClient : public std::enable_shared_from_this<SocketcandClient> {
 public:
  SocketcandClient(boost::asio::ip::tcp::socket socket, SocketcandServer& server)
      : socket_(std::move(socket)), pause_(socket_.get_executor()), server_(&server) {}

  void start();
  bool is_open() const { return socket_.is_open(); }
  /// Reads at most one buffer.
  void read();
  /// Sends the text of a bus frame, if the client is in raw mode.
  void hear(std::string_view frame);
  void close();

 private:
  void write();
  void obey(std::string_view element);
  void answer(std::string_view element);
  void send(std::string_view text);
  /// Holds frames back for a while, or until the client sends something.
  void pause();
  void resume();

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer pause_;
  SocketcandServer* server_;
  can_client::ElementReader reader_;
  std::array<char, 1024> buffer_{};
  std::string waiting_;
  std::string in_flight_;
  std::string held_;  ///< frames held back
  bool opened_ = false;
  bool raw_ = false;
  bool paused_ = false;
  bool reading_ = false;
};

}  // namespace supercoil::host_sim
