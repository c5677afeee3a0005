// Progress of a long task, and the time left.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <unistd.h>

namespace supercoil {

/// "34 s", "12 min"
inline std::string duration_text(double seconds) {
  constexpr double minute_s = 60.0;
  const bool short_one = seconds < 2.0 * minute_s;
  return std::to_string(std::lround(short_one ? seconds : seconds / minute_s)) +
         (short_one ? " s" : " min");
}

/// A line on standard error, rewritten in place, after the first two seconds. Silent unless
/// standard error is a terminal.
class Progress {
 public:
  /// quiet: silent on a terminal too.
  Progress(std::string what, bool quiet)
      : what_(std::move(what)), shows_(!quiet && isatty(STDERR_FILENO) == 1) {}
  ~Progress() { end(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  /// done: 0 to 1, from which the time left is computed; NaN: not known. detail: further text.
  /// Cheap: most calls only read the clock.
  void show(double done, const std::string& detail) {
    const Clock::time_point now = Clock::now();
    if (!shows_ || now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    std::string text = what_ + ":";
    if (done >= 0.0) text += " " + std::to_string(std::lround(100.0 * done)) + " %";
    if (!detail.empty()) text += "  " + detail;
    if (done > 0.0) text += ", " + duration_text(left_s(done)) + " left";
    shown_ = true;
    std::fprintf(stderr, "\r\033[K%s", text.c_str());
    std::fflush(stderr);
  }
  /// Clears the line, so that the next message starts on an empty one.
  void end() {
    if (shown_) std::fputs("\r\033[K", stderr);
    shown_ = false;
  }
  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// When nothing is shown, callers need not compute the progress.
  bool shows() const { return shows_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// `done` may grow in steps; between two steps the time left counts down.
  double left_s(double done) {
    if (done != done_) ends_s_ = elapsed_s() / done;
    done_ = done;
    return std::fmax(0.0, ends_s_ - elapsed_s());
  }

  std::string what_;
  bool shows_;
  bool shown_ = false;
  double done_ = 0.0;
  double ends_s_ = 0.0;  ///< estimated when done_ last changed
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + std::chrono::seconds(2);
};

}  // namespace supercoil
