// HTTP requests to the monitor: the whole server, one connection for each input.
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include "apps/supercoil/monitor/api.hpp"
#include "apps/supercoil/monitor/command_request.hpp"
#include "apps/supercoil/monitor/server_thread.hpp"
#include "fuzz/fuzz.hpp"
#include "telemetry/frames.hpp"

using namespace supercoil;
using namespace supercoil::operating;

namespace {

/// A page without a board: every command that is let through tries to open the bus.
class Page {
 public:
  Page()
      : frame_history_(60.0, 500e3),
        controls_([this](std::uint8_t) { return bus(); }),
        access_{"127.0.0.1", 0, std::string(32, 'a'), true, false} {
    bind_exclusively(server_);
    server_.set_read_timeout(1);
    server_.set_keep_alive_max_count(1);
    server_.set_payload_max_length(4096);
    access_.port = server_.bind_to_any_port(access_.host);
    api_ = std::make_unique<Api>(access_, frame_history_, controls_, Api::About{"can0", false, 1});
    api_->serve_with(server_);
    thread_ = std::make_unique<ServerThread>(server_);
  }

  /// The first bytes of the answer.
  std::string request_page(std::string_view request) const {
    const int file = connected();
    ::send(file, request.data(), request.size(), MSG_NOSIGNAL);
    ::shutdown(file, SHUT_WR);
    std::string answer(64, '\0');
    ssize_t size = -1;
    do {
      size = ::recv(file, answer.data(), answer.size(), 0);
    } while (size < 0 && errno == EINTR);
    answer.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    ::close(file);
    return answer;
  }
  bool was_asked() const { return asked_; }

 private:
  /// Retries: libFuzzer's own timer sometimes interrupts a connection, and thousands of connections
  /// a second may use up the ports for a while.
  int connected() const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(access_.port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    int error = 0;
    for (int tries = 0; tries < 30; ++tries) {
      const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
      // Close at once, without lingering.
      const linger none{1, 0};
      ::setsockopt(file, SOL_SOCKET, SO_LINGER, &none, sizeof(none));
      if (::connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0)
        return file;
      error = errno;
      ::close(file);
      if (error == EINTR) continue;
      if (error != EADDRNOTAVAIL) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    std::fprintf(stderr, "connect: %s\n", std::strerror(error));
    fuzz::require(false, "the page can be reached");
    return -1;
  }
  ManualControl::OpenBus bus() {
    return [this]() -> Result<std::unique_ptr<hal::CanBus>> {
      asked_ = true;
      return failure("there is none");
    };
  }

  std::atomic<bool> asked_{false};
  FrameHistory frame_history_;
  ManualControls controls_;
  Access access_;
  httplib::Server server_;
  std::unique_ptr<Api> api_;
  std::unique_ptr<ServerThread> thread_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Page page;
  const std::string_view input = fuzz::text(data, size);
  if (const auto order = parse_command_request(std::string(input))) {
    fuzz::require(order->node >= 1 && order->node <= can::max_nodes, "a node is one of 63");
    fuzz::require(order->verb != Verb::none && std::isfinite(order->value), "an order can be sent");
  }
  // A stream has no end.
  if (input.find("stream") != std::string_view::npos) return 0;
  const std::string answer = page.request_page(input);
  fuzz::require(answer.empty() || answer.starts_with("HTTP/1.1 "), "an answer is one of HTTP");
  const bool has_token = input.find(std::string(32, 'a')) != std::string_view::npos;
  fuzz::require(has_token || !page.was_asked(), "nobody commands without the token");
  return 0;
}
