// STOP, whatever else the monitor does.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "operator/monitor/access.hpp"
#include "operator/monitor/hand.hpp"
#include "operator/monitor/recent.hpp"
#include "operator/monitor/server_thread.hpp"

namespace supercoil::operating {

/// A server of its own, with a thread and a connection to the bus of its own: POST /stop disarms
/// every node that was heard.
class StopServer {
 public:
  /// let_go: tells the hands. port: the one after the page's if it is free, else any. recent
  /// outlives it. The error says why it cannot listen.
  static tl::expected<std::unique_ptr<StopServer>, std::string> start(const Access& access,
                                                                      Hand::OpenBus open_bus,
                                                                      const Recent& recent,
                                                                      std::function<void()> let_go);
  StopServer(const StopServer&) = delete;
  StopServer& operator=(const StopServer&) = delete;

  int port() const { return port_; }

 private:
  StopServer(Access access, Hand::OpenBus open_bus, const Recent& recent,
             std::function<void()> let_go);
  void stop(const httplib::Request& request, httplib::Response& response);
  /// Empty: done.
  std::string disarm_all();

  Access access_;
  Hand::OpenBus open_bus_;
  const Recent* recent_;
  std::function<void()> let_go_;
  std::mutex mutex_;  ///< of the bus
  std::unique_ptr<hal::CanBus> bus_;
  httplib::Server server_;
  int port_ = 0;
  std::unique_ptr<ServerThread> thread_;
};

}  // namespace supercoil::operating
