// An open file of the operating system.
#pragma once

#include <cerrno>
#include <cstddef>
#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal/status.hpp"

namespace supercoil::hal_linux {

/// Owns a file descriptor; closes it when it ends. Move-only.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) noexcept : number_(number) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  bool is_open() const noexcept { return number_ >= 0; }
  int number() const noexcept { return number_; }
  void close() noexcept;

 private:
  int number_ = -1;
};

/// Opens a file, closed on exec. flags: O_RDONLY … The error names the path.
Result<Descriptor> open_file(const std::string& path, int flags);

/// The result of a read or write.
struct Transfer {
  std::size_t bytes = 0;
  hal::Status status = hal::Status::ok;
};

/// Reads from the file's start, which makes sysfs ask the driver again. 0 bytes is an io_error: no
/// attribute is empty.
Transfer read_start(const Descriptor& file, char* buffer, std::size_t size) noexcept;
/// Writes all of it at the file's start; less is an io_error.
hal::Status write_start(const Descriptor& file, const char* data, std::size_t size) noexcept;
/// Reads the next bytes of a device.
Transfer read_next(const Descriptor& file, char* buffer, std::size_t size) noexcept;
/// Writes all of it to a device; less is an io_error.
hal::Status write_next(const Descriptor& file, const char* data, std::size_t size) noexcept;

/// Repeats a call that a signal interrupts, but not for ever: a tick must end even in a storm of
/// signals, or when a driver answers EINTR for its own reasons.
template <class Call>
auto uninterrupted(const Call& call) noexcept {
  constexpr int max_repetitions = 16;
  auto result = call();
  for (int i = 0; result < 0 && errno == EINTR && i < max_repetitions; ++i)
    result = call();
  return result;
}

}  // namespace supercoil::hal_linux
