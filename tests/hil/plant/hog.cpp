// supercoil-rig-hog: keeps the processor busy in real time, as a runaway program does.
//   supercoil-rig-hog PRIORITY SECONDS
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <sched.h>

namespace {

double now_s() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fputs("supercoil-rig-hog PRIORITY SECONDS\n", stderr);
    return 2;
  }
  const sched_param parameters{std::atoi(arguments[1])};
  if (sched_setscheduler(0, SCHED_FIFO, &parameters) != 0) {
    std::perror("supercoil-rig-hog");
    return 1;
  }
  const double end_s = now_s() + std::atof(arguments[2]);
  while (now_s() < end_s) {
  }
  return 0;
}
