// One connection to the STOP port: a request, an answer, the end.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

#include "apps/supercoil/monitor/stop_listener.hpp"

namespace supercoil::operating {

/// Used by the listener's thread, which it never blocks.
class StopConnection : public std::enable_shared_from_this<StopConnection> {
 public:
  StopConnection(boost::asio::ip::tcp::socket socket, const StopListener::Take& take)
      : socket_(std::move(socket)), deadline_(socket_.get_executor()), take_(&take) {}

  void start();
  void close();
  bool is_open() const { return socket_.is_open(); }
  /// Whether its request is complete.
  bool has_request() const { return has_request_; }

 private:
  void take_request();
  void answer(const StopListener::Reply& reply);
  void close_after(std::chrono::milliseconds time);

  /// A browser's request has some 600 bytes.
  static constexpr std::uint32_t max_header_bytes = 8192;
  static constexpr std::uint64_t max_body_bytes = 256;

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer deadline_;
  const StopListener::Take* take_;
  boost::beast::flat_buffer buffer_{max_header_bytes + max_body_bytes};
  boost::beast::http::request_parser<boost::beast::http::string_body> parser_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  bool has_request_ = false;
};

}  // namespace supercoil::operating
