// Fake GPIO chips. gpio_kernel_v1.cpp and _v2.cpp implement libgpiod's functions on them and
// replace the library.
#pragma once

#include <cerrno>
#include <map>
#include <string>
#include <vector>

#include "supercoil/hal_linux/gpio_chip.hpp"

namespace supercoil::test {

struct FakeLine {
  std::string name;
  std::string consumer;  ///< empty: nobody
  bool output = false;
  int value = 0;
  hal_linux::Bias bias = hal_linux::Bias::unknown;
  std::vector<std::string> history;  ///< "output 0", "set 1", "release"
};

struct FakeChip {
  std::string name;  ///< gpiochip0
  std::string label;
  std::vector<FakeLine> lines;
};

struct GpioKernel {
  std::map<std::string, FakeChip> chips;  ///< by path
  int opened = 0;                         ///< chips that are open
  int fails_with = 0;                     ///< errno of every set, get and request; 0: no error

  FakeChip* open(const std::string& path) {
    const auto chip = chips.find(path);
    if (chip == chips.end()) {
      errno = ENOTTY;
      return nullptr;
    }
    ++opened;
    return &chip->second;
  }
  int request(FakeLine& line, bool output, int value, const char* consumer) const {
    if (!line.consumer.empty() || fails_with != 0) {
      errno = line.consumer.empty() ? fails_with : EBUSY;
      return -1;
    }
    line.consumer = consumer;
    line.output = output;
    if (output) line.value = value;
    line.history.push_back(output ? "output " + std::to_string(value) : "input");
    return 0;
  }
  int set(FakeLine& line, int value) const {
    line.history.push_back("set " + std::to_string(value));
    if (fails_with != 0 || !line.output) {
      errno = fails_with != 0 ? fails_with : EPERM;
      return -1;
    }
    line.value = value;
    return 0;
  }
  int get(const FakeLine& line) const {
    if (fails_with == 0) return line.value;
    errno = fails_with;
    return -1;
  }
  static void release(FakeLine& line) {
    line.consumer.clear();
    line.history.emplace_back("release");
  }
};

/// The only instance in this program.
inline GpioKernel& gpio_kernel() {
  static GpioKernel only;
  return only;
}

}  // namespace supercoil::test
