// A child process, for work that would end or change the test's own process.
#pragma once

#include <array>
#include <csignal>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace supercoil::test {

/// Runs work(write end of a pipe) in a child process, which then exits without clean-up.
class Child {
 public:
  template <class Work>
  explicit Child(Work work) {
    std::array<int, 2> ends{-1, -1};
    if (pipe(ends.data()) != 0) return;
    pid_ = fork();
    if (pid_ == 0) {
      close(ends[0]);
      work(ends[1]);
      _exit(0);
    }
    close(ends[1]);
    output_ = ends[0];
  }
  ~Child() {
    if (pid_ > 0) end(SIGKILL);
    close(output_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for at most this many bytes from the child; returns fewer at its end.
  std::string read(std::size_t bytes) const {
    std::string text(bytes, '\0');
    std::size_t have = 0;
    for (ssize_t count = 1; count > 0 && have < bytes;) {
      count = ::read(output_, text.data() + have, bytes - have);
      if (count > 0) have += static_cast<std::size_t>(count);
    }
    return text.substr(0, have);
  }

  /// Sends a signal (0: none) and waits for the end; returns the status of waitpid.
  int end(int signal) {
    if (signal != 0) kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return status;
  }

 private:
  pid_t pid_ = -1;
  int output_ = -1;
};

}  // namespace supercoil::test
