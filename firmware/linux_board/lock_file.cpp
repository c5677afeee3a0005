#include "linux_board/lock_file.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace supercoil::linux_board {

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

std::string content(const hal_linux::Descriptor& file) {
  std::array<char, 32> text{};
  const ssize_t count = ::pread(file.number(), text.data(), text.size(), 0);
  std::string all(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  while (!all.empty() && all.back() == '\n')
    all.pop_back();
  return all;
}

}  // namespace

tl::expected<LockFile, std::string> LockFile::take(const std::string& path) {
  hal_linux::Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!file.is_open()) {
    return tl::unexpected(path + ": the lock file cannot be made: " + reason(errno));
  }
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    if (error != EWOULDBLOCK) return tl::unexpected(path + ": cannot be locked: " + reason(error));
    return tl::unexpected(path + ": another supercoild drives this board, process " +
                          content(file));
  }
  const std::string mine = std::to_string(::getpid()) + "\n";
  // Who it is helps people; the lock itself does not hang on it.
  if (::ftruncate(file.number(), 0) == 0) {
    static_cast<void>(::pwrite(file.number(), mine.data(), mine.size(), 0) < 0);
  }
  return LockFile(std::move(file));
}

}  // namespace supercoil::linux_board
