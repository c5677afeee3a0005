#include "socketcand/server.hpp"

#include <chrono>
#include <utility>

#include "socketcand/client.hpp"

namespace supercoil::host_sim {

using boost::asio::ip::tcp;

namespace {

constexpr auto retry_after = std::chrono::milliseconds(100);

}  // namespace

Result<std::unique_ptr<SocketcandServer>> SocketcandServer::listen(std::uint16_t port,
                                                                   std::string interface,
                                                                   Deliver deliver) {
  const tcp::endpoint endpoint(boost::asio::ip::address_v4::loopback(), port);
  try {
    return std::make_unique<SocketcandServer>(endpoint, std::move(interface), std::move(deliver));
  } catch (const boost::system::system_error& error) {
    return failure("socketcand: port " + std::to_string(port) +
                   " of loopback: " + error.code().message());
  }
}

SocketcandServer::SocketcandServer(const tcp::endpoint& endpoint, std::string interface,
                                   Deliver deliver)
    : acceptor_(io_, endpoint),
      retry_(io_),
      interface_(std::move(interface)),
      deliver_(std::move(deliver)) {
  accept();
}

SocketcandServer::~SocketcandServer() {
  for (const auto& client : clients_)
    client->close();
}

void SocketcandServer::accept() {
  acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
    if (error) return accept_later();
    if (clients_.size() < max_clients) {
      clients_.push_back(std::make_shared<SocketcandClient>(std::move(socket), *this));
      clients_.back()->start();
    }
    accept();
  });
}

void SocketcandServer::accept_later() {
  retry_.expires_after(retry_after);
  retry_.async_wait([this](boost::system::error_code) { accept(); });
}

void SocketcandServer::poll() {
  for (const auto& client : clients_)
    client->read();
  io_.poll();
  std::erase_if(clients_, [](const auto& client) { return !client->is_open(); });
}

void SocketcandServer::take(const hal::CanFrame& frame, const SocketcandClient& from) {
  deliver_(frame);
  send(frame, newest_, &from);
}

void SocketcandServer::send(const hal::CanFrame& frame, hal::Time at, const SocketcandClient* but) {
  newest_ = at;
  const std::string text = can_client::frame_text(frame, at);
  for (const auto& client : clients_) {
    if (client.get() != but && client->is_open()) client->hear(text);
  }
}

}  // namespace supercoil::host_sim
