#include "storage/posix_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace supercoil::storage {

namespace {

tl::unexpected<Error> failed(const std::string& path, const char* what) {
  return failed_call(path + ": " + what, errno);
}

/// Repeats a system call for as long as a signal interrupts it.
template <class Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR)
    result = call();
  return result;
}

Result<void> done(int result, const std::string& path, const char* what) {
  if (result == 0) return {};
  return failed(path, what);
}

/// close() without a retry: on Linux the descriptor is gone even after EINTR, and another thread
/// may already use its number.
int close_once(int descriptor) {
  const int result = ::close(descriptor);
  return result != 0 && errno == EINTR ? 0 : result;
}

/// A descriptor that is closed when it goes out of scope.
class Opened {
 public:
  Opened(const std::string& path, int flags)
      : descriptor_(uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC); })) {}
  ~Opened() {
    if (descriptor_ >= 0) close_once(descriptor_);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

Result<std::string> PosixFiles::read(const std::string& path, std::size_t limit_bytes) {
  // Without O_NONBLOCK a pipe in the file's place would block the start for ever.
  const Opened file(path, O_RDONLY | O_NONBLOCK);
  if (file.descriptor() < 0) return failed(path, "cannot be opened");
  std::string content(limit_bytes, '\0');
  std::size_t have = 0;
  while (have < limit_bytes) {
    const ssize_t count = uninterrupted(
        [&] { return ::read(file.descriptor(), content.data() + have, limit_bytes - have); });
    if (count < 0) return failed(path, "cannot be read");
    if (count == 0) break;
    have += static_cast<std::size_t>(count);
  }
  content.resize(have);
  return content;
}

Result<NewFile> PosixFiles::create(const std::string& path) {
  constexpr mode_t readable_by_all = 0644;
  const int descriptor = uninterrupted([&] {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, readable_by_all);
  });
  if (descriptor < 0) return failed(path, "cannot be created");
  return NewFile{descriptor, path};
}

Result<void> PosixFiles::write(const NewFile& file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::write(file.descriptor, content.data(), content.size()); });
    if (count == 0) errno = EIO;  // no disk does this; without an error it would go on for ever
    if (count <= 0) return failed(file.path, "cannot be written");
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

Result<void> PosixFiles::sync(const NewFile& file) {
  return done(uninterrupted([&] { return ::fsync(file.descriptor); }), file.path,
              "cannot be written to the disk");
}

Result<void> PosixFiles::close(const NewFile& file) {
  return done(close_once(file.descriptor), file.path, "cannot be closed");
}

Result<void> PosixFiles::rename(const std::string& from, const std::string& to) {
  return done(std::rename(from.c_str(), to.c_str()), to, "cannot be replaced");
}

Result<void> PosixFiles::link(const std::string& from, const std::string& to) {
  return done(::link(from.c_str(), to.c_str()), to, "cannot be linked (hard link)");
}

Result<void> PosixFiles::unlink(const std::string& path) {
  return done(::unlink(path.c_str()), path, "cannot be removed");
}

Result<void> PosixFiles::sync_folder(const std::string& path) {
  const Opened folder(path, O_RDONLY | O_DIRECTORY);
  if (folder.descriptor() < 0) return failed(path, "cannot be opened");
  return done(uninterrupted([&] { return ::fsync(folder.descriptor()); }), path,
              "cannot be written to the disk");
}

Result<void> PosixFiles::check_folder(const std::string& path) {
  const Opened folder(path, O_RDONLY | O_DIRECTORY);
  if (folder.descriptor() < 0) return failed(path, "cannot be opened as a folder");
  return {};
}

}  // namespace supercoil::storage
