// Signals end a write early or before it starts; the written file must still be complete.
#include <array>
#include <csignal>
#include <string>
#include <thread>

#include <sys/time.h>
#include <unistd.h>

#include <CppUTest/TestHarness.h>

#include "storage/posix_files.hpp"

using namespace supercoil::storage;

namespace {

void nothing(int) {}

/// Interrupts this thread's system calls every 200 µs during its lifetime.
class Interruptions {
 public:
  Interruptions() {
    struct sigaction action {};
    action.sa_handler = nothing;  // and no SA_RESTART: calls end with EINTR, or partly done
    sigaction(SIGALRM, &action, &old_);
    const itimerval often{{0, 200}, {0, 200}};
    setitimer(ITIMER_REAL, &often, nullptr);
  }
  ~Interruptions() {
    const itimerval never{};
    setitimer(ITIMER_REAL, &never, nullptr);
    sigaction(SIGALRM, &old_, nullptr);
  }
  Interruptions(const Interruptions&) = delete;
  Interruptions& operator=(const Interruptions&) = delete;

 private:
  struct sigaction old_ {};
};

/// A thread without SIGALRM, so that the interruptions hit the thread under test.
template <class Work>
std::thread undisturbed(Work work) {
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, &alarm, &before);
  std::thread thread(work);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

TEST_GROUP(InterruptedWrite){};

TEST(InterruptedWrite, ContinuesUntilAllIsWritten) {
  PosixFiles files;
  std::array<int, 2> ends{};
  LONGS_EQUAL(0, pipe(ends.data()));
  std::string sent(4 << 20, '\0');
  for (std::size_t i = 0; i < sent.size(); ++i)
    sent[i] = static_cast<char>(i * 2654435761U >> 13);
  std::string received;
  // The pipe is nearly always full, so that most writes wait and are interrupted.
  std::thread reader = undisturbed([&] {
    std::string part(1 << 14, '\0');
    for (ssize_t count = 1; count > 0;) {
      usleep(20);
      count = read(ends[0], part.data(), part.size());
      received.append(part, 0, count > 0 ? static_cast<std::size_t>(count) : 0);
    }
  });
  {
    const Interruptions interruptions;
    CHECK(files.write({ends[1], "pipe"}, sent).has_value());
  }
  CHECK(files.close({ends[1], "pipe"}).has_value());
  reader.join();
  close(ends[0]);
  CHECK(received == sent);
}
