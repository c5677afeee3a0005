// How far a long run is.
#pragma once

#include <chrono>
#include <string>

namespace supercoil::host_sim {

/// Silent for the first two seconds; then a line on standard error, rewritten in place on a
/// terminal and a new one every ten seconds elsewhere.
class Progress {
 public:
  Progress(std::string what, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  /// done: 0 to 1; detail: what else to say. Cheap: looks at the clock only.
  void show(double done, const std::string& detail);
  /// Takes its line off a terminal, so that the next message has one of its own.
  void end();
  double elapsed_s() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace supercoil::host_sim
