#include "apps/supercoil/bus/socketcand_bus.hpp"

#include <thread>

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>

namespace supercoil::operating {

using boost::asio::ip::tcp;

namespace {

constexpr auto first_timeout = std::chrono::seconds(2);
constexpr auto retry_timeout = std::chrono::seconds(1);

/// What happened, and the likely cause. request: empty before the greeting.
std::string problem_text(const std::string& request, bool is_open) {
  if (!is_open) return "closed the connection";
  if (!request.empty()) return "did not answer '" + request + "' in time: it is stopped or busy";
  return "accepted the connection but did not send '< hi >' in time: it is stopped or busy, or not "
         "a socketcand server";
}

}  // namespace

Result<std::unique_ptr<SocketcandBus>> SocketcandBus::open(const SocketcandAddress& address) {
  auto bus = std::make_unique<SocketcandBus>(address);
  if (auto connected = bus->connect(first_timeout); !connected)
    return tl::unexpected(connected.error());
  return bus;
}

Result<void> SocketcandBus::connect(Clock::duration timeout) {
  const auto deadline = Clock::now() + timeout;
  next_try_ = deadline;
  reader_ = {};
  boost::system::error_code error = boost::asio::error::timed_out;
  tcp::resolver resolver(io_);
  boost::system::error_code unknown;
  const auto places = resolver.resolve(address_.host, std::to_string(address_.port), unknown);
  if (unknown) return failure(address_.host + ": " + unknown.message());
  boost::asio::async_connect(socket_, places,
                             [&](boost::system::error_code e, const tcp::endpoint&) { error = e; });
  io_.restart();
  io_.run_until(deadline);
  const auto fail = [&](const std::string& why) -> Result<void> {
    disconnect();
    return failure(why);
  };
  if (!io_.stopped()) {
    disconnect();
    io_.run();
    return fail("no answer");
  }
  if (error) return fail(error.message());
  boost::system::error_code ignored;
  socket_.set_option(tcp::no_delay(true), ignored);
  socket_.non_blocking(true, ignored);
  for (const std::string& request :
       {std::string(), "< open " + address_.interface + " >", std::string("< rawmode >")}) {
    const std::string expected = request.empty() ? "hi" : "ok";
    if (!request.empty() && !write(request)) return fail("closed the connection");
    const auto answer = element_until(deadline);
    if (!answer) return fail(problem_text(request, socket_.is_open()));
    if (*answer != expected) return fail("answered '" + *answer + "' to '" + request + "'");
  }
  return {};
}

std::optional<std::string> SocketcandBus::element_until(Clock::time_point deadline) {
  while (socket_.is_open() && Clock::now() < deadline) {
    if (auto element = reader_.take()) return element;
    read();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return reader_.take();
}

void SocketcandBus::disconnect() {
  boost::system::error_code ignored;
  socket_.close(ignored);
}

/// A partial write ends the connection: half an element would corrupt the next one.
bool SocketcandBus::write(const std::string& text) {
  boost::system::error_code error;
  const std::size_t sent = socket_.write_some(boost::asio::buffer(text), error);
  if (error == boost::asio::error::would_block) return false;
  if (error || sent != text.size()) disconnect();
  return socket_.is_open();
}

void SocketcandBus::read() {
  boost::system::error_code error;
  const std::size_t bytes = socket_.read_some(boost::asio::buffer(buffer_), error);
  if (error == boost::asio::error::would_block) return;
  if (error) return disconnect();
  reader_.put({buffer_.data(), bytes});
}

hal::Status SocketcandBus::send(const hal::CanFrame& frame) {
  if (!socket_.is_open()) return hal::Status::gone;
  if (write(can_client::send_text(frame))) return hal::Status::ok;
  return socket_.is_open() ? hal::Status::busy : hal::Status::gone;
}

hal::Status SocketcandBus::receive(hal::CanFrame& frame) {
  if (!socket_.is_open()) {
    if (Clock::now() < next_try_ || !connect(retry_timeout)) return hal::Status::gone;
  }
  for (bool has_read = false;;) {
    const auto element = reader_.take();
    if (!element && has_read) break;
    if (!element) read();
    has_read = has_read || !element;
    const auto parsed = element ? can_client::parse_frame(*element) : std::nullopt;
    if (!parsed) continue;
    frame = *parsed;
    return hal::Status::ok;
  }
  return socket_.is_open() ? hal::Status::not_ready : hal::Status::gone;
}

}  // namespace supercoil::operating
