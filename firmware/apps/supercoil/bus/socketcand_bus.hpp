// A CAN bus that a socketcand server offers over TCP.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

#include "apps/supercoil/bus/bus_name.hpp"
#include "can_client/socketcand.hpp"

namespace supercoil::operating {

/// Used by one thread. A lost connection is `down`, and every call answers gone; receive() then
/// tries every second to reconnect, which takes up to a second when the host does not answer.
class SocketcandBus final : public hal::CanBus {
 public:
  /// Waits at most 2 s. The error contains the server's answer, or says that there was none.
  static Result<std::unique_ptr<SocketcandBus>> open(const SocketcandAddress& address);
  explicit SocketcandBus(SocketcandAddress address) : address_(std::move(address)) {}

  hal::Status send(const hal::CanFrame& frame) override;
  /// CanFrame::received is the server's time.
  hal::Status receive(hal::CanFrame& frame) override;
  hal::CanState state() const override {
    return socket_.is_open() ? hal::CanState::active : hal::CanState::down;
  }

 private:
  using Clock = std::chrono::steady_clock;

  Result<void> connect(Clock::duration timeout);
  /// The next element from the server; empty: none arrived in time.
  std::optional<std::string> element_until(Clock::time_point deadline);
  bool write(const std::string& text);
  void read();
  void disconnect();

  SocketcandAddress address_;
  boost::asio::io_context io_;
  boost::asio::ip::tcp::socket socket_{io_};
  can_client::ElementReader reader_;
  std::array<char, 65536> buffer_{};
  Clock::time_point next_try_{};
};

}  // namespace supercoil::operating
