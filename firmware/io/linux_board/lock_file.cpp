#include "linux_board/lock_file.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace supercoil::linux_board {

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// What is wrong with the opened file. Empty: nothing. Its folder may belong to the service's user,
/// who could put anything in the lock's place: root must not write into another user's file.
std::string objection(const hal_linux::Descriptor& file, const std::string& path) {
  struct stat found {};
  if (::fstat(file.number(), &found) != 0) return "cannot be examined: " + reason(errno);
  if (!S_ISREG(found.st_mode)) return "is not a regular file";
  if (found.st_nlink != 1)
    return "has " + std::to_string(found.st_nlink) + " names (hard links) and may be another file";
  const std::string folder = path.substr(0, path.rfind('/') + 1) + ".";
  struct stat above {};
  const bool known = ::stat(folder.c_str(), &above) == 0;
  const uid_t owner = found.st_uid;
  if (owner == 0 || owner == ::geteuid() || (known && owner == above.st_uid)) return {};
  return "belongs to user " + std::to_string(owner) +
         ", not to root, to this user or to its folder's owner";
}

/// Why open() failed, from errno.
std::string open_failure(int error) {
  if (error == ELOOP) return "the lock file is a symbolic link, which is not followed";
  const std::string why = "the lock file cannot be created: " + reason(error);
  return error == ENOENT ? why + "; create its folder, or name another (--run-folder)" : why;
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

Result<LockFile> LockFile::take(const std::string& path) {
  // Without O_NONBLOCK a device in the file's place could block the start for ever.
  constexpr int flags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  hal_linux::Descriptor file(::open(path.c_str(), flags, 0644));
  if (!file.is_open()) return failure(path + ": " + open_failure(errno));
  if (const std::string wrong = objection(file, path); !wrong.empty())
    return failure(path + ": the lock file " + wrong);
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    if (error != EWOULDBLOCK) return failure(path + ": cannot be locked: " + reason(error));
    return failure(path + ": another supercoild drives this board, process " + content(file));
  }
  const std::string mine = std::to_string(::getpid()) + "\n";
  // The process id is for people; the lock does not depend on it.
  if (::ftruncate(file.number(), 0) == 0) {
    static_cast<void>(::pwrite(file.number(), mine.data(), mine.size(), 0) < 0);
  }
  return LockFile(std::move(file));
}

}  // namespace supercoil::linux_board
