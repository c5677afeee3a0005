#include "apps/supercoil/monitor/stop_connection.hpp"

#include <string_view>

#include <boost/asio/post.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>

namespace supercoil::operating {

namespace http = boost::beast::http;

namespace {

/// From accepting to a complete request. A browser connects when it has the request to send.
constexpr auto max_request_time = std::chrono::milliseconds(250);
/// From the complete request to the end: the bus may be busy for half a second.
constexpr auto max_answer_time = std::chrono::seconds(2);

std::string text(boost::beast::string_view view) {
  return {view.data(), view.size()};
}

}  // namespace

void StopConnection::start() {
  boost::system::error_code ignored;
  socket_.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  parser_.header_limit(max_header_bytes);
  parser_.body_limit(max_body_bytes);
  close_after(max_request_time);
  http::async_read(socket_, buffer_, parser_,
                   [self = shared_from_this()](boost::system::error_code error, std::size_t) {
                     if (error) return self->close();
                     self->take_request();
                   });
}

void StopConnection::close() {
  boost::system::error_code ignored;
  // Closes a connection without a request so that nothing remains in the kernel either.
  if (!has_request_) socket_.set_option(boost::asio::socket_base::linger(true, 0), ignored);
  socket_.close(ignored);
  deadline_.cancel();
}

void StopConnection::close_after(std::chrono::milliseconds time) {
  deadline_.expires_after(time);
  deadline_.async_wait([self = weak_from_this()](boost::system::error_code error) {
    const auto still = self.lock();
    if (!error && still) still->close();
  });
}

void StopConnection::take_request() {
  has_request_ = true;
  close_after(max_answer_time);
  httplib::Request request;
  request.method = text(parser_.get().method_string());
  request.path = text(parser_.get().target());
  request.body = parser_.get().body();
  for (const auto& field : parser_.get())
    request.set_header(text(field.name_string()), text(field.value()));
  (*take_)(request, [self = weak_from_this(),
                     executor = socket_.get_executor()](const StopListener::Reply& reply) {
    boost::asio::post(executor, [self, reply] {
      if (const auto still = self.lock()) still->answer(reply);
    });
  });
}

void StopConnection::answer(const StopListener::Reply& reply) {
  response_.result(static_cast<unsigned>(reply.status));
  response_.set(http::field::content_type, "application/json");
  response_.set(http::field::cache_control, "no-store");
  if (!reply.allowed_origin.empty())
    response_.set(http::field::access_control_allow_origin, reply.allowed_origin);
  response_.body() = reply.json;
  response_.keep_alive(false);
  response_.prepare_payload();
  http::async_write(
      socket_, response_,
      [self = shared_from_this()](boost::system::error_code, std::size_t) { self->close(); });
}

}  // namespace supercoil::operating
