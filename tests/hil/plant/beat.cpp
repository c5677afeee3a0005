// supercoil-rig-beat: beats the heartbeat as the firmware does, by the kernel's GPIO interface and
// in real time, holds other lines high, and reports how late it woke. For tests of the rig itself.
//   supercoil-rig-beat CHIP_LABEL PERIOD_us EDGES [HIGH_LINE...]
// When it ends, nobody drives the lines: they return to their pulls.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <linux/gpio.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// By its label: chip numbers change with the kernel.
int open_chip(const std::string& label, unsigned& lines) {
  for (int i = 0; i < 32; ++i) {
    const int chip = open(("/dev/gpiochip" + std::to_string(i)).c_str(), O_RDWR | O_CLOEXEC);
    if (chip < 0) continue;
    gpiochip_info info{};
    if (ioctl(chip, GPIO_GET_CHIPINFO_IOCTL, &info) == 0 && label == info.label) {
      lines = info.lines;
      return chip;
    }
    close(chip);
  }
  throw std::runtime_error("no GPIO chip is labelled " + label);
}

unsigned offset_of(int chip, unsigned lines, const std::string& name) {
  for (unsigned offset = 0; offset < lines; ++offset) {
    gpio_v2_line_info info{};
    info.offset = offset;
    if (ioctl(chip, GPIO_V2_GET_LINEINFO_IOCTL, &info) == 0 && name == info.name) return offset;
  }
  throw std::runtime_error("no line is named " + name);
}

/// All lines in one request, the first low and the others high.
int take_lines(int chip, unsigned lines, const std::vector<std::string>& names) {
  gpio_v2_line_request request{};
  std::strncpy(request.consumer, "supercoil-rig-beat", sizeof request.consumer - 1);
  for (const std::string& name : names)
    request.offsets[request.num_lines++] = offset_of(chip, lines, name);
  request.config.flags = GPIO_V2_LINE_FLAG_OUTPUT;
  request.config.num_attrs = 1;
  request.config.attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
  request.config.attrs[0].mask = (1ULL << request.num_lines) - 1;
  request.config.attrs[0].attr.values = request.config.attrs[0].mask & ~1ULL;
  if (ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &request) != 0) fail("request of the lines");
  return request.fd;
}

void beat(int request, long period_ns, long edges) {
  timespec wake{}, woken{};
  clock_gettime(CLOCK_MONOTONIC, &wake);
  long late_ns = 0, latest_ns = 0;
  for (long edge = 1; edge <= edges; ++edge) {
    wake.tv_nsec += period_ns;
    wake.tv_sec += wake.tv_nsec / 1000000000;
    wake.tv_nsec %= 1000000000;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
    clock_gettime(CLOCK_MONOTONIC, &woken);
    const long now_late_ns =
        (woken.tv_sec - wake.tv_sec) * 1000000000 + woken.tv_nsec - wake.tv_nsec;
    late_ns += now_late_ns;
    latest_ns = std::max(latest_ns, now_late_ns);
    gpio_v2_line_values values{static_cast<__u64>(edge % 2), 1};
    if (ioctl(request, GPIO_V2_LINE_SET_VALUES_IOCTL, &values) != 0) fail("heartbeat");
  }
  std::printf("beat: %ld edges; woken late by %ld us in the mean, %ld us at most\n", edges,
              late_ns / std::max(edges, 1L) / 1000, latest_ns / 1000);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count < 4) throw std::runtime_error("expects CHIP_LABEL PERIOD_us EDGES [HIGH_LINE...]");
    std::vector<std::string> names{"HEARTBEAT"};
    names.insert(names.end(), arguments + 4, arguments + count);
    unsigned lines = 0;
    const int chip = open_chip(arguments[1], lines);
    const int request = take_lines(chip, lines, names);
    const sched_param priority{80};
    if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0 ||
        sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
      fail("real-time priority");
    beat(request, std::stol(arguments[2]) * 1000, std::stol(arguments[3]));
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "supercoil-rig-beat: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
