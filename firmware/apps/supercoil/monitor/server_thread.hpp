// An HTTP server that runs until it is destroyed.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "apps/supercoil/monitor/httplib.hpp"

namespace supercoil::operating {

/// The server is already bound, and outlives this object.
class ServerThread {
 public:
  explicit ServerThread(httplib::Server& server)
      : server_(&server), thread_([this] {
          server_->listen_after_bind();
          ended_ = true;
        }) {}
  ServerThread(const ServerThread&) = delete;
  ServerThread& operator=(const ServerThread&) = delete;
  ~ServerThread() {
    // Stopping a server that does not listen yet has no effect, and it would then listen for ever.
    while (!server_->is_running() && !ended_)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    server_->stop();
    thread_.join();
  }

 private:
  httplib::Server* server_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace supercoil::operating
