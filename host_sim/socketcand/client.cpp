#include "socketcand/client.hpp"

#include <chrono>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>

#include "can_client/text.hpp"
#include "socketcand/server.hpp"

namespace supercoil::host_sim {

namespace {

constexpr std::size_t max_waiting = 1U << 20U;
/// Clients expect < ok > alone in their next read.
constexpr auto pause_after_ok = std::chrono::milliseconds(200);

}  // namespace

void SocketcandClient::start() {
  boost::system::error_code ignored;
  socket_.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
  send("< hi >");
}

void SocketcandClient::close() {
  boost::system::error_code ignored;
  socket_.close(ignored);
  pause_.cancel();
}

void SocketcandClient::read() {
  if (reading_) return;
  reading_ = true;
  socket_.async_read_some(
      boost::asio::buffer(buffer_),
      [self = shared_from_this()](boost::system::error_code error, std::size_t bytes) {
        if (error) return self->close();
        self->reading_ = false;
        self->reader_.put({self->buffer_.data(), bytes});
        while (const auto element = self->reader_.take())
          self->obey(*element);
      });
}

void SocketcandClient::hear(std::string_view frame) {
  if (!raw_) return;
  if (!paused_) return send(frame);
  if (held_.size() + frame.size() > max_waiting) return close();
  held_ += frame;
}

void SocketcandClient::pause() {
  paused_ = true;
  pause_.expires_after(pause_after_ok);
  pause_.async_wait([self = shared_from_this()](boost::system::error_code error) {
    if (!error) self->resume();
  });
}

void SocketcandClient::resume() {
  if (!paused_) return;
  paused_ = false;
  send(std::exchange(held_, {}));
}

void SocketcandClient::send(std::string_view text) {
  if (in_flight_.size() + waiting_.size() + text.size() > max_waiting) return close();
  waiting_ += text;
  if (in_flight_.empty()) write();
}

void SocketcandClient::write() {
  in_flight_.swap(waiting_);
  if (in_flight_.empty()) return;
  boost::asio::async_write(
      socket_, boost::asio::buffer(in_flight_),
      [self = shared_from_this()](boost::system::error_code error, std::size_t) {
        if (error) return self->close();
        self->in_flight_.clear();
        self->write();
      });
}

void SocketcandClient::answer(std::string_view element) {
  send("< " + std::string(element) + " >");
}

void SocketcandClient::obey(std::string_view element) {
  resume();  // a client that sends something has read the < ok >
  std::string_view rest = element;
  const std::string_view word = next_word(rest);
  if (word == "echo") return answer(element);
  if (word == "open") {
    opened_ = next_word(rest) == server_->interface_;
    return answer(opened_ ? "ok" : "error could not open bus: there is " + server_->interface_);
  }
  if (!opened_) return answer("error open a bus first");
  if (word == "rawmode") {
    raw_ = true;
    answer("ok");
    return pause();
  }
  const auto frame = can_client::parse_send(element);
  if (!frame)
    return answer("error unknown command, or not a classical frame with an 11-bit identifier");
  server_->take(*frame, *this);
}

}  // namespace supercoil::host_sim
