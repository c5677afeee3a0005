#include "unit/hal_linux/support/system_calls.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <ctime>
#include <list>
#include <mutex>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <pthread.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

namespace supercoil::test {

namespace {

struct Waiting {
  Call call;
  std::string path;
  Answer answer;
};

struct State {
  std::mutex lock;
  std::list<Waiting> waiting;
  Driver driver;
  Control control;
  Netlink netlink;
  std::vector<std::byte> netlink_answer;
  dev_t device = 0;
};

State& state() {
  static State only;
  return only;
}

std::string path_of(int file) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = ::readlink(link.c_str(), path.data(), path.size());
  return {path.data(), static_cast<std::size_t>(size < 0 ? 0 : size)};
}

/// The pending answer for such a call.
std::optional<Answer> waiting_for(Call call, const std::string& path) {
  const std::lock_guard guard(state().lock);
  auto& all = state().waiting;
  for (auto it = all.begin(); it != all.end(); ++it) {
    if (it->call != call || !path.ends_with(it->path)) continue;
    Answer answer = std::move(it->answer);
    all.erase(it);
    return answer;
  }
  return {};
}

}  // namespace

void next(Call call, std::string_view path, Answer answer) {
  const std::lock_guard guard(state().lock);
  state().waiting.push_back({call, std::string(path), std::move(answer)});
}

void fail_next(Call call, std::string_view path, int error, int times) {
  for (int i = 0; i < times; ++i)
    next(call, path, [error] { return -error; });
}

std::size_t waiting() {
  const std::lock_guard guard(state().lock);
  return state().waiting.size();
}

void set_driver(Driver driver) {
  state().driver = std::move(driver);
}

void set_control(Control control) {
  state().control = std::move(control);
}

void set_netlink(Netlink netlink) {
  state().netlink = std::move(netlink);
}

void set_device(unsigned major, unsigned minor) {
  state().device = ::gnu_dev_makedev(major, minor);
}

void reset_calls() {
  const std::lock_guard guard(state().lock);
  state().waiting.clear();
  state().driver = nullptr;
  state().control = nullptr;
  state().netlink = nullptr;
  state().device = 0;
}

}  // namespace supercoil::test

namespace {

using supercoil::test::Call;

/// A kernel's answer as the C library gives it.
long as_libc(long answer) {
  if (answer >= 0) return answer;
  errno = static_cast<int>(-answer);
  return -1;
}

template <class Real>
long instead(Call call, const std::string& path, const Real& real) {
  if (auto answer = supercoil::test::waiting_for(call, path)) return as_libc((*answer)());
  return real();
}

/// For calls that return an errno instead of setting it.
template <class Real>
int errno_instead(Call call, const Real& real) {
  if (auto answer = supercoil::test::waiting_for(call, "")) return static_cast<int>(-(*answer)());
  return real();
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's names
extern "C" {
int __real_open(const char* path, int flags, ...);
int __real_access(const char* path, int mode);
int __real_stat(const char* path, struct stat* about);
ssize_t __real_send(int socket, const void* data, std::size_t size, int flags);
ssize_t __real_recv(int socket, void* data, std::size_t size, int flags);
ssize_t __real_pread(int file, void* data, std::size_t size, off_t offset);
ssize_t __real_pwrite(int file, const void* data, std::size_t size, off_t offset);
ssize_t __real_read(int file, void* data, std::size_t size);
ssize_t __real_write(int file, const void* data, std::size_t size);
int __real_clock_nanosleep(clockid_t clock, int flags, const timespec* until, timespec* left);
int __real_mlockall(int flags);
int __real_pthread_setschedparam(pthread_t thread, int policy, const sched_param* parameters);
int __real_pthread_setaffinity_np(pthread_t thread, std::size_t size, const cpu_set_t* set);

int __wrap_open(const char* path, int flags, mode_t mode) {
  return static_cast<int>(
      instead(Call::open, path, [&] { return __real_open(path, flags, mode); }));
}
int __wrap_access(const char* path, int mode) {
  return static_cast<int>(instead(Call::access, path, [&] { return __real_access(path, mode); }));
}
ssize_t __wrap_pread(int file, void* data, std::size_t size, off_t offset) {
  return instead(Call::pread, supercoil::test::path_of(file),
                 [&] { return __real_pread(file, data, size, offset); });
}
ssize_t __wrap_pwrite(int file, const void* data, std::size_t size, off_t offset) {
  const std::string path = supercoil::test::path_of(file);
  return instead(Call::pwrite, path, [&]() -> long {
    const auto& driver = supercoil::test::state().driver;
    if (driver) return as_libc(driver(path, {static_cast<const char*>(data), size}));
    return __real_pwrite(file, data, size, offset);
  });
}
ssize_t __wrap_read(int file, void* data, std::size_t size) {
  return instead(Call::read, supercoil::test::path_of(file),
                 [&] { return __real_read(file, data, size); });
}
ssize_t __wrap_write(int file, const void* data, std::size_t size) {
  return instead(Call::write, supercoil::test::path_of(file),
                 [&] { return __real_write(file, data, size); });
}
int __wrap_ioctl(int file, unsigned long request, void* argument) {
  return static_cast<int>(instead(Call::ioctl, supercoil::test::path_of(file), [&]() -> long {
    const auto& control = supercoil::test::state().control;
    return as_libc(control ? control(request, argument) : -ENOTTY);
  }));
}
int __wrap_stat(const char* path, struct stat* about) {
  const int done = __real_stat(path, about);
  const dev_t device = supercoil::test::state().device;
  if (done == 0 && device != 0 && S_ISCHR(about->st_mode)) about->st_rdev = device;
  return done;
}
ssize_t __wrap_send(int socket, const void* data, std::size_t size, int flags) {
  auto& state = supercoil::test::state();
  if (!state.netlink) return __real_send(socket, data, size, flags);
  const auto* const bytes = static_cast<const std::byte*>(data);
  state.netlink_answer = state.netlink({bytes, bytes + size});
  return static_cast<ssize_t>(size);
}
ssize_t __wrap_recv(int socket, void* data, std::size_t size, int flags) {
  auto& state = supercoil::test::state();
  if (!state.netlink) return __real_recv(socket, data, size, flags);
  const std::size_t bytes = std::min(size, state.netlink_answer.size());
  std::copy_n(state.netlink_answer.begin(), bytes, static_cast<std::byte*>(data));
  return static_cast<ssize_t>(bytes);
}
int __wrap_clock_nanosleep(clockid_t clock, int flags, const timespec* until, timespec* left) {
  return errno_instead(Call::clock_nanosleep,
                       [&] { return __real_clock_nanosleep(clock, flags, until, left); });
}
int __wrap_mlockall(int flags) {
  return static_cast<int>(instead(Call::mlockall, "", [&] { return __real_mlockall(flags); }));
}
int __wrap_pthread_setschedparam(pthread_t thread, int policy, const sched_param* parameters) {
  return errno_instead(Call::set_scheduling,
                       [&] { return __real_pthread_setschedparam(thread, policy, parameters); });
}
int __wrap_pthread_setaffinity_np(pthread_t thread, std::size_t size, const cpu_set_t* set) {
  return errno_instead(Call::set_affinity,
                       [&] { return __real_pthread_setaffinity_np(thread, size, set); });
}
}
// NOLINTEND(bugprone-reserved-identifier)
