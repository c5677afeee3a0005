#include "supercoil/hal_linux/descriptor.hpp"

#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "supercoil/hal_linux/status_of.hpp"

namespace supercoil::hal_linux {

namespace {

Transfer transfer(ssize_t result) noexcept {
  if (result < 0) return {0, status_of(errno)};
  if (result == 0) return {0, hal::Status::io_error};
  return {static_cast<std::size_t>(result), hal::Status::ok};
}

hal::Status all_written(ssize_t result, std::size_t size) noexcept {
  const Transfer written = transfer(result);
  if (written.status != hal::Status::ok) return written.status;
  return written.bytes == size ? hal::Status::ok : hal::Status::io_error;
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    close();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

Descriptor::~Descriptor() {
  close();
}

void Descriptor::close() noexcept {
  // Not repeated after EINTR: on Linux the number is free by then, and may be another thread's.
  if (is_open()) ::close(std::exchange(number_, -1));
}

Result<Descriptor> open_file(const std::string& path, int flags) {
  const int number = uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC); });
  if (number < 0) return failed_call("cannot open " + path, errno);
  return Descriptor(number);
}

Transfer read_start(const Descriptor& file, char* buffer, std::size_t size) noexcept {
  return transfer(uninterrupted([&] { return ::pread(file.number(), buffer, size, 0); }));
}

hal::Status write_start(const Descriptor& file, const char* data, std::size_t size) noexcept {
  return all_written(uninterrupted([&] { return ::pwrite(file.number(), data, size, 0); }), size);
}

Transfer read_next(const Descriptor& file, char* buffer, std::size_t size) noexcept {
  return transfer(uninterrupted([&] { return ::read(file.number(), buffer, size); }));
}

hal::Status write_next(const Descriptor& file, const char* data, std::size_t size) noexcept {
  return all_written(uninterrupted([&] { return ::write(file.number(), data, size); }), size);
}

}  // namespace supercoil::hal_linux
