// The STOP port: a slow or silent client never blocks another.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/monitor/httplib.hpp"

namespace supercoil::operating {

class StopConnection;

/// For STOP's threads: the calling thread gets the processor before others do, if the system
/// permits this user that (RLIMIT_NICE). No real-time priority: flooding STOP's port would then
/// take a processor from everything else.
void take_precedence();

/// One thread that never waits for a connection. Each connection must deliver a complete request
/// within 250 ms of being accepted. When too many are open, the oldest without one is closed.
class StopListener {
 public:
  struct Reply {
    int status = 200;
    std::string allowed_origin;  ///< empty: no other origin may read the answer
    std::string json;
  };
  /// Safe from any thread while the listener lives, even when the connection is gone.
  using Answer = std::function<void(Reply)>;
  /// Called in the listener's thread with every complete request; must not wait.
  using Take = std::function<void(const httplib::Request&, Answer)>;

  /// port: the wanted one; another is taken if it is not free. The error says why there is none.
  static Result<std::unique_ptr<StopListener>> open(const std::string& host, int port);
  StopListener() = default;
  StopListener(const StopListener&) = delete;
  StopListener& operator=(const StopListener&) = delete;
  ~StopListener();

  int port() const { return port_; }
  void start(Take take);

 private:
  boost::system::error_code listen(const std::string& host, int port);
  void accept();
  void accept_later();
  void close_oldest();

  Take take_;
  boost::asio::io_context io_;
  boost::asio::ip::tcp::acceptor acceptor_{io_};
  boost::asio::steady_timer retry_{io_};
  int port_ = 0;
  std::list<std::shared_ptr<StopConnection>> connections_;  ///< oldest first
  std::thread thread_;
};

}  // namespace supercoil::operating
